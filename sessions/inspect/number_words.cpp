#include "sessions/inspect/number_words.h"

#include <array>
#include <charconv>

namespace herr {

std::string with_decimals(double value, int decimals) {
  std::array<char, 352> buffer;  // the longest double has 309 digits before the point
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals);
  return std::string(buffer.data(), end.ptr);
}

std::string milliseconds(TimeNs ns) {
  return with_decimals(static_cast<double>(ns) * 1e-6, 1) + " ms";
}

std::string percentage(std::int64_t part, std::int64_t all) {
  return with_decimals(100 * static_cast<double>(part) / static_cast<double>(all), 1) + " %";
}

std::string counted(std::int64_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace herr
