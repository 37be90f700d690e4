#include "server/study/report/figure_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "server/text/number_text.h"

namespace herr {

std::string figure(double value, int digits) {
  if (!std::isfinite(value)) return kNoFigure;
  if (value == 0) return "0";
  std::array<char, 64> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::scientific, digits - 1);
  const std::string text(buffer.data(), end.ptr);
  // Of the rounded value: 9.996 has the exponent of 10.0.
  const std::size_t mark = text.find('e');
  const int exponent = std::stoi(text.substr(mark + 1));
  if (exponent < -4 || exponent > 5) return text;
  return fixed_text(value, std::max(digits - 1 - exponent, 0));
}

std::string figure(const Interval& value, int digits) {
  if (!std::isfinite(value.estimate)) return kNoFigure;
  return figure(value.estimate, digits) + " [" + figure(value.lower, digits) + ", " +
         figure(value.upper, digits) + "]";
}

std::string count_figure(double value) {
  if (!(std::abs(value) < 1e15)) return figure(value);
  return fixed_text(value, std::abs(value) < 100 && value != std::floor(value) ? 1 : 0);
}

std::string fixed_figure(double value, int decimals) {
  return std::abs(value) < 1e15 ? fixed_text(value, decimals) : figure(value);
}

std::string percent_figure(double share) {
  return std::isfinite(100 * share) ? fixed_figure(100 * share, 0) + " %" : kNoFigure;
}

}  // namespace herr
