#include "server/study/error/flip_filters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace herr {
namespace {

constexpr double kPi = glm::pi<double>();

// A Gaussian of contrast sensitivity: a sqrt(pi / b) exp(-pi^2 d^2 / b), d in degrees.
struct Sensitivity {
  double a, b;
  double height() const { return a * std::sqrt(kPi / b); }
};
constexpr Sensitivity kAchromatic{1, 0.0047}, kRedGreen{1, 0.0053}, kBlueYellowWide{34.1, 0.04},
    kBlueYellowNarrow{13.5, 0.025};
constexpr double kLargestB = 0.04;
constexpr double kDetectorWidthDeg = 0.082;

template <class Weight>
std::vector<double> sampled(int radius, const Weight& weight) {
  std::vector<double> values;
  for (int k = -radius; k <= radius; ++k) values.push_back(weight(k));
  return values;
}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

FlipFilter scaled(const std::vector<double>& values, double factor) {
  FlipFilter filter;
  for (const double value : values) filter.weights.push_back(static_cast<float>(value * factor));
  return filter;
}

// Positive weights add up to 1, negative ones to -1. Pixels so large that one of the two vanishes: all are 0.
FlipFilter balanced(const std::vector<double>& values) {
  double positive = 0, negative = 0;
  for (const double value : values) (value > 0 ? positive : negative) += std::abs(value);
  if (!(positive > 0 && negative > 0)) return scaled(values, 0);
  FlipFilter filter;
  for (const double value : values)
    filter.weights.push_back(static_cast<float>(value / (value > 0 ? positive : negative)));
  return filter;
}

}  // namespace

FlipFilters::FlipFilters(double pixels_per_degree) {
  const int wide =
      static_cast<int>(std::ceil(3 * std::sqrt(kLargestB / (2 * kPi * kPi)) * pixels_per_degree));
  const auto gaussian = [&](double b) {
    return sampled(wide, [&](int k) {
      const double d = k / pixels_per_degree;
      return std::exp(-kPi * kPi * d * d / b);
    });
  };
  const auto a = gaussian(kAchromatic.b), rg = gaussian(kRedGreen.b);
  achromatic = scaled(a, 1 / sum_of(a));
  red_green = scaled(rg, 1 / sum_of(rg));
  const auto by1 = gaussian(kBlueYellowWide.b), by2 = gaussian(kBlueYellowNarrow.b);
  const double sum1 = sum_of(by1), sum2 = sum_of(by2);
  const double total = kBlueYellowWide.height() * sum1 * sum1 + kBlueYellowNarrow.height() * sum2 * sum2;
  wide_rows = scaled(by1, 1);
  narrow_rows = scaled(by2, 1);
  wide_columns = scaled(by1, kBlueYellowWide.height() / total);
  narrow_columns = scaled(by2, kBlueYellowNarrow.height() / total);

  const double sigma = 0.5 * kDetectorWidthDeg * pixels_per_degree;
  const int detector = static_cast<int>(std::ceil(3 * sigma));
  const auto g = [&](int k) { return std::exp(-0.5 * k * k / (sigma * sigma)); };
  const auto smooth_values = sampled(detector, g);
  smooth = scaled(smooth_values, 1 / sum_of(smooth_values));
  edge = balanced(sampled(detector, [&](int k) { return -k * g(k); }));
  point = balanced(sampled(detector, [&](int k) { return (k * k / (sigma * sigma) - 1) * g(k); }));
  radius = std::max(wide, detector);
}

void flip_convolve(const FlipFilter& filter, const float* middle, std::ptrdiff_t step, std::size_t count,
                   float* out) {
  const std::ptrdiff_t radius = filter.radius();
  const float* const weights = filter.weights.data() + radius;
  for (std::size_t first = 0; first < count; first += kFlipBlock) {
    std::array<float, kFlipBlock> sum{};
    for (std::ptrdiff_t k = -radius; k <= radius; ++k) {
      const float weight = weights[k];
      const float* const in = middle + static_cast<std::ptrdiff_t>(first) + k * step;
      for (std::size_t i = 0; i < kFlipBlock; ++i) sum[i] += weight * in[i];
    }
    std::copy(sum.begin(), sum.end(), out + first);
  }
}

}  // namespace herr
