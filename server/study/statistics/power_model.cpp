#include "server/study/statistics/power_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace herr {
namespace {

// Below this share of itself, what n^p adds to a constant is rounding.
constexpr double kCollinear = 1e-24;

double square(double x) {
  return x * x;
}

}  // namespace

struct PowerModel::Column {
  std::vector<double> values;  // n^p / error in units of the largest
  double log_unit = 0;
  double sum = 0, squares = 0, by_inverse = 0;
  // Of the part at right angles to 1 / error, by subtraction before squaring: exact for small p as well.
  double free_sum = 0, free_squares = 0;

  bool collinear() const { return free_squares <= kCollinear * squares; }
};

PowerModel::PowerModel(std::span<const double> n, std::span<const double> error, bool with_floor)
    : with_floor_(with_floor) {
  for (const double x : n) log_mean_n_ += std::log(x) / static_cast<double>(n.size());
  log_least_error_ = std::log(*std::min_element(error.begin(), error.end()));
  for (std::size_t i = 0; i < n.size(); ++i) {
    log_n_.push_back(std::log(n[i]) - log_mean_n_);
    log_error_.push_back(std::log(error[i]) - log_least_error_);
    inverse_.push_back(std::exp(-log_error_.back()));
    inverse_sum_ += inverse_.back();
    inverse_squares_ += square(inverse_.back());
  }
}

PowerModel::Column PowerModel::column_at(double p) const {
  Column column;
  column.log_unit = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < log_n_.size(); ++i) {
    column.values.push_back(p * log_n_[i] - log_error_[i]);
    column.log_unit = std::max(column.log_unit, column.values.back());
  }
  for (std::size_t i = 0; i < log_n_.size(); ++i) {
    double& value = column.values[i];
    value = std::exp(value - column.log_unit);
    column.sum += value;
    column.squares += square(value);
    column.by_inverse += value * inverse_[i];
  }
  for (std::size_t i = 0; i < log_n_.size(); ++i) {
    const double free = column.values[i] - column.by_inverse / inverse_squares_ * inverse_[i];
    column.free_sum += free;
    column.free_squares += square(free);
  }
  return column;
}

double PowerModel::sum_at(const Column& column, double floor, double size) const {
  double sum = 0;
  for (std::size_t i = 0; i < inverse_.size(); ++i) {
    sum += square(floor * inverse_[i] + size * column.values[i] - 1);
  }
  return sum;
}

PowerModel::Best PowerModel::best_of(double p, const Column& column, double floor, double size) const {
  Best best;
  best.floor = floor * std::exp(log_least_error_);
  best.c = size * std::exp(log_least_error_ - column.log_unit - p * log_mean_n_);
  best.sum = sum_at(column, floor, size);
  return best;
}

PowerModel::Best PowerModel::at(double p) const {
  const Column column = column_at(p);
  const Best without_floor = best_of(p, column, 0, column.sum / column.squares);
  if (!with_floor_ || column.collinear()) return without_floor;
  const double size = column.free_sum / column.free_squares;
  const double floor = (inverse_sum_ - size * column.by_inverse) / inverse_squares_;
  if (size >= 0 && floor >= 0) return best_of(p, column, floor, size);
  const Best constant = best_of(p, column, inverse_sum_ / inverse_squares_, 0);
  return constant.sum < without_floor.sum ? constant : without_floor;
}

std::optional<PowerModel::Floors> PowerModel::floors_within(double p, double limit) const {
  if (at(p).sum > limit) return std::nullopt;
  const Column column = column_at(p);
  const auto width = [&](double floor, double size, double curvature) {
    return std::sqrt(std::max(0.0, limit - sum_at(column, floor, size)) / curvature);
  };
  // The sum with the best c is a parabola of the floor up to where that c is 0, and another one with c = 0
  // from there.
  const double constant = inverse_sum_ / inverse_squares_;
  const double constant_width = width(constant, 0, inverse_squares_);
  Floors floors{0, constant + constant_width};
  if (!column.collinear()) {
    const double size = column.free_sum / column.free_squares;
    const double floor = (inverse_sum_ - size * column.by_inverse) / inverse_squares_;
    const double floor_width = width(floor, size, inverse_squares_ * column.free_squares / column.squares);
    const double turn = column.sum / column.by_inverse;
    floors.lower = floor - floor_width < turn ? floor - floor_width : constant - constant_width;
    if (floor + floor_width < turn) floors.upper = floor + floor_width;
  }
  const double unit = std::exp(log_least_error_);
  return Floors{std::max(0.0, floors.lower) * unit, std::max(0.0, floors.upper) * unit};
}

double PowerModel::sum_of_rounding() const {
  return static_cast<double>(log_n_.size()) * square(400 * std::numeric_limits<double>::epsilon());
}

}  // namespace herr
