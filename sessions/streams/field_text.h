// Text of one field of a row. Before: who cuts lines into fields (csv_rows, import/tables).
// After: numbers and messages.
#pragma once

#include <string>
#include <string_view>

#include "sessions/files/input_error.h"

namespace herr {

// Without the spaces and tabs around it.
inline std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// For messages.
inline std::string in_quotes(std::string_view text) {
  return "'" + printable(std::string(text)) + "'";
}

}  // namespace herr
