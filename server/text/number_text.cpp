#include "server/text/number_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace herr {
namespace {

std::string padding_for(const std::string& text, int width) {
  const auto wanted = static_cast<std::size_t>(width);
  return std::string(text.size() < wanted ? wanted - text.size() : 0, ' ');
}

}  // namespace

std::string shortest_text(double value) {
  if (!std::isfinite(value)) return "n/a";
  std::array<char, 32> buffer;  // 17 digits, sign, point and exponent
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), result.ptr);
}

std::string minutes_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::ceil(seconds));
  const std::string rest = std::to_string(whole % 60);
  return std::to_string(whole / 60) + ":" + (rest.size() < 2 ? "0" : "") + rest;
}

std::string right_aligned(const std::string& text, int width) {
  return padding_for(text, width) + text;
}

std::string left_aligned(const std::string& text, int width) {
  return text + padding_for(text, width);
}

}  // namespace herr
