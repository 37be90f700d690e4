// The linear half of a power law's fit: for a given p the best floor >= 0 and c >= 0 of error = floor + c n^p
// in relative residuals. Before: points of a measurement. After: power_fit, which moves p.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace herr {

class PowerModel {
 public:
  PowerModel(std::span<const double> n, std::span<const double> error, bool with_floor);

  struct Best {
    double floor = 0, c = 0;  // c of n = 1
    double sum = 0;           // of squared relative residuals
  };
  Best at(double p) const;

  struct Floors {
    double lower = 0, upper = 0;
  };
  // The floors for which some c leaves a sum of `limit` at most; none where there is none. Of a model with
  // floor.
  std::optional<Floors> floors_within(double p, double limit) const;

  // A sum of squares that rounding alone may leave: residuals are exact to some 100 units in the last place.
  double sum_of_rounding() const;

 private:
  struct Column;  // n^p / error and its products
  Column column_at(double p) const;
  double sum_at(const Column& column, double floor, double size) const;
  Best best_of(double p, const Column& column, double floor, double size) const;

  // n in units of its geometric mean and errors in units of the smallest, so that no power overflows.
  std::vector<double> log_n_, log_error_;
  std::vector<double> inverse_;  // 1 / error
  double log_mean_n_ = 0, log_least_error_ = 0;
  double inverse_sum_ = 0, inverse_squares_ = 0;
  bool with_floor_ = false;
};

}  // namespace herr
