#include "server/study/statistics/power_fit.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <set>
#include <stdexcept>

#include "server/study/statistics/power_model.h"

namespace herr {
namespace {

constexpr double kMostPower = 8;
constexpr double kPowerStep = 1.0 / 64;
constexpr int kFloorSteps = 256;
constexpr double kQuantile = 0.975;
constexpr int kHalvings = 60;     // of a step: to the last digit
constexpr int kGoldenSteps = 60;  // 0.618^60 = 3e-13 of a step
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void require_points(std::span<const double> n, std::span<const double> error) {
  if (n.size() != error.size()) throw std::invalid_argument("a power law needs one error for each n");
  const auto fits = [](double x) { return std::isfinite(x) && x > 0; };
  if (!std::all_of(n.begin(), n.end(), fits) || !std::all_of(error.begin(), error.end(), fits)) {
    throw std::invalid_argument("a power law is fitted to positive, finite values");
  }
}

struct ScanRange {
  double from = 0, to = 0;
  int steps = 1;
};

// Where `of` is least: at a point of the grid, or in the steps beside it by golden section. Stays at `start`
// unless another place is better by more than `slack`.
double least_place(const std::function<double(double)>& of, const ScanRange& range, double start,
                   double slack) {
  const double step = (range.to - range.from) / range.steps;
  double best = start, value = of(start);
  const auto take_better = [&](double place, double there) {
    if (there < value - slack) best = place, value = there;
  };
  for (int i = 0; i <= range.steps; ++i) take_better(range.from + step * i, of(range.from + step * i));

  const double share = (std::sqrt(5.0) - 1) / 2;
  double left = std::max(range.from, best - step), right = std::min(range.to, best + step);
  double a = right - share * (right - left), b = left + share * (right - left);
  double of_a = of(a), of_b = of(b);
  for (int i = 0; i < kGoldenSteps; ++i) {
    if (of_a < of_b) {
      right = b, b = a, of_b = of_a;
      a = right - share * (right - left), of_a = of(a);
    } else {
      left = a, a = b, of_a = of_b;
      b = left + share * (right - left), of_b = of(b);
    }
  }
  take_better(a, of_a);
  take_better(b, of_b);
  return best;
}

// The outermost p on one side (-1 or 1) of the estimate that still fits.
double power_bound(const PowerModel& model, double estimate, double side, double limit) {
  const auto fits = [&](double p) { return model.at(p).sum <= limit; };
  double outside = side * kMostPower;
  if (fits(outside)) return side * kInfinity;
  double inside = outside - side * kPowerStep;
  while (side * (inside - estimate) > 0 && !fits(inside)) outside = inside, inside -= side * kPowerStep;
  if (side * (inside - estimate) < 0) inside = estimate;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (inside + outside);
    (fits(middle) ? inside : outside) = middle;
  }
  return inside;
}

// The least and the largest floor of all p that fit.
Interval floor_interval(const PowerModel& model, const Interval& p, double estimate, double limit) {
  const ScanRange range{std::max(-kMostPower, p.lower), std::min(kMostPower, p.upper), kFloorSteps};
  const auto lower = [&](double power) {
    const auto floors = model.floors_within(power, limit);
    return floors ? floors->lower : kInfinity;
  };
  const auto negative_upper = [&](double power) {
    const auto floors = model.floors_within(power, limit);
    return floors ? -floors->upper : kInfinity;
  };
  return {estimate, lower(least_place(lower, range, p.estimate, 0)),
          -negative_upper(least_place(negative_upper, range, p.estimate, 0))};
}

}  // namespace

std::optional<PowerFit> fit_power(std::span<const double> n, std::span<const double> error, bool with_floor) {
  require_points(n, error);
  const std::size_t parameters = with_floor ? 3 : 2;
  if (n.size() < parameters + 1) return std::nullopt;
  if (std::set<double>(n.begin(), n.end()).size() < parameters) return std::nullopt;

  const PowerModel model(n, error, with_floor);
  const auto sum_at = [&](double p) { return model.at(p).sum; };
  const ScanRange powers{-kMostPower, kMostPower, static_cast<int>(2 * kMostPower / kPowerStep)};
  PowerFit fit;
  fit.p.estimate = least_place(sum_at, powers, 0, model.sum_of_rounding());
  const PowerModel::Best best = model.at(fit.p.estimate);
  fit.c = best.c;
  fit.points = static_cast<int>(n.size());
  fit.relative_rms = std::sqrt(best.sum / static_cast<double>(n.size()));

  const auto freedom = static_cast<double>(n.size() - parameters);
  const double t = boost::math::quantile(boost::math::students_t(freedom), kQuantile);
  const double limit = std::max(best.sum, model.sum_of_rounding()) * (1 + t * t / freedom);
  fit.p.lower = power_bound(model, fit.p.estimate, -1, limit);
  fit.p.upper = power_bound(model, fit.p.estimate, 1, limit);
  fit.floor = with_floor ? floor_interval(model, fit.p, best.floor, limit) : Interval{0, 0, 0};
  return fit;
}

}  // namespace herr
