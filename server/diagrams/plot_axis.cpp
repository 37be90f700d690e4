#include "server/diagrams/plot_axis.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace herr {
namespace {

constexpr double kLeastSpan = 0.602;  // decades: a factor of 4
constexpr double kMargin = 0.04;      // of the span
constexpr int kMostLabels = 8;

// mantissa * 10^exponent as the nearest double; 0 or infinite outside the range of doubles.
double power_of_ten(int mantissa, int exponent) {
  const std::string text = std::to_string(mantissa) + "e" + std::to_string(exponent);
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

// Plain near 1. The exponent is lifted by dy: baseline-shift is not known everywhere.
std::string tick_label(int mantissa, int exponent) {
  if (exponent >= 0 && exponent <= 3)
    return std::to_string(mantissa) + std::string(static_cast<std::size_t>(exponent), '0');
  if (exponent < 0 && exponent >= -3)
    return "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + std::to_string(mantissa);
  return (mantissa == 1 ? "" : std::to_string(mantissa) + "\u00d7") + "10<tspan dy=\"-5\" font-size=\"9\">" +
         std::to_string(exponent) + "</tspan>";
}

}  // namespace

LogAxis::LogAxis(std::span<const double> values, double low_px, double high_px)
    : low_px_(low_px), high_px_(high_px) {
  bool any = false;
  for (const double value : values) {
    if (!(value > 0) || !std::isfinite(value)) continue;
    const double x = std::log10(value);
    low_ = any ? std::min(low_, x) : x;
    high_ = any ? std::max(high_, x) : x;
    any = true;
  }
  const double margin = std::max(kMargin * (high_ - low_), (kLeastSpan - (high_ - low_)) / 2);
  low_ -= margin;
  high_ += margin;
}

std::optional<double> LogAxis::place(double value) const {
  if (!(value > 0) || !std::isfinite(value)) return std::nullopt;
  const double share = std::clamp((std::log10(value) - low_) / (high_ - low_), 0.0, 1.0);
  return low_px_ + share * (high_px_ - low_px_);
}

double LogAxis::lower() const {
  return std::pow(10.0, low_);
}

double LogAxis::upper() const {
  return std::pow(10.0, high_);
}

std::vector<PlotTick> LogAxis::ticks() const {
  const int first = static_cast<int>(std::ceil(low_)), last = static_cast<int>(std::floor(high_));
  const int decades = std::max(last - first + 1, 0);
  const auto inside = [&](int mantissa, int exponent) {
    const double x = std::log10(mantissa) + exponent;
    return x >= low_ && x <= high_;
  };
  const auto count = [&](std::string_view mantissas) {
    int found = 0;
    for (int exponent = first - 1; exponent <= last; ++exponent) {
      for (const char c : mantissas) found += inside(c - '0', exponent);
    }
    return found;
  };
  std::string_view labelled = "1";
  if (decades < 3) labelled = count("125") >= 3 ? "125" : "12357";
  const int step = (decades + kMostLabels - 1) / kMostLabels;
  std::vector<PlotTick> ticks;
  for (int exponent = first - 1; exponent <= last; ++exponent) {
    for (int mantissa = 1; mantissa < 10; ++mantissa) {
      const double value = power_of_ten(mantissa, exponent);
      if (!inside(mantissa, exponent) || !(value > 0) || !std::isfinite(value)) continue;
      const bool label = labelled.find(static_cast<char>('0' + mantissa)) != std::string_view::npos &&
                         (step <= 1 || (exponent - first) % step == 0);
      if (!label && decades > (mantissa == 1 ? 24 : 4)) continue;
      ticks.push_back({value, label ? tick_label(mantissa, exponent) : ""});
    }
  }
  return ticks;
}

}  // namespace herr
