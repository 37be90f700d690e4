#include "server/text/number_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

namespace herr {
namespace {

// The longest fixed notation of a double has 309 digits before the point; 20 after it is the most we print.
using Buffer = std::array<char, 352>;

std::string padding_for(const std::string& text, int width) {
  const auto wanted = static_cast<std::size_t>(width);
  return std::string(text.size() < wanted ? wanted - text.size() : 0, ' ');
}

}  // namespace

std::string fixed_text(double value, int decimals) {
  if (!std::isfinite(value)) return "n/a";
  Buffer buffer;
  const auto result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals);
  return std::string(buffer.data(), result.ptr);
}

std::string shortest_text(double value) {
  if (!std::isfinite(value)) return "n/a";
  Buffer buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), result.ptr);
}

std::string right_aligned(const std::string& text, int width) {
  return padding_for(text, width) + text;
}

std::string left_aligned(const std::string& text, int width) {
  return text + padding_for(text, width);
}

}  // namespace herr
