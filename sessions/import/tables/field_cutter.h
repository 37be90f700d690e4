// A line of a table cut into fields. Before: a line. After: table_layout, delimited_table.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace herr {

// Cuts the first field off `rest`, without blanks and quotes around it; a separator within quotes is none.
// `separator` ' ': any run of spaces and tabs. False when `rest` held the last field.
bool take_field(std::string_view& rest, char separator, std::string_view& field);

// All fields; an empty last one after a trailing separator included.
void cut_fields(std::string_view line, char separator, std::vector<std::string_view>& fields);

// Without the empty ones at the end.
std::size_t filled_fields(const std::vector<std::string_view>& fields);

// "commas", "semicolons", "tabs", "blanks"; as maps write them: ",", ";", "tab", "spaces".
const char* separator_name(char separator);
const char* separator_key(char separator);

}  // namespace herr
