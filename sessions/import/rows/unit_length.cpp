#include "sessions/import/rows/unit_length.h"

#include <array>
#include <charconv>
#include <cmath>

namespace herr {

double unit_divisor(const RowSource& rows, double length, const char* what, const char* when_zero,
                    ReadingCounts& counts) {
  const double off = std::abs(length - 1);
  if (off <= kUnitRounding) return 1;
  if (!(off <= kUnitLimit))
    rows.fail(std::string(what) + " has the length " + short_number(length) + ", not 1",
              length == 0 ? when_zero : "check the columns of the map, or remove the line");
  if (off > kUnitSlack) ++counts.normalised;
  return length;
}

std::string short_number(double value) {
  std::array<char, 32> text{};
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6);
  return error == std::errc() ? std::string(text.data(), end) : "?";
}

}  // namespace herr
