#include "server/study/relations/light/seed_means.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace herr {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

std::vector<double> mean_row(const SeedRows& rows) {
  std::vector<double> mean(rows.front().size());
  for (const auto& row : rows) {
    for (std::size_t p = 0; p < mean.size(); ++p) mean[p] += double{row[p]};
  }
  for (double& value : mean) value /= static_cast<double>(rows.size());
  return mean;
}

SeedRows differences(const SeedRows& tested, const SeedRows& reference) {
  SeedRows out = tested;
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (std::size_t p = 0; p < out[i].size(); ++p) out[i][p] -= reference[i][p];
  }
  return out;
}

// All products <D_i, D_j>, n x n.
std::vector<double> products_of(const SeedRows& rows) {
  const std::size_t n = rows.size();
  std::vector<double> products(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i; j < n; ++j) {
      double sum = 0;
      for (std::size_t p = 0; p < rows[i].size(); ++p) sum += double{rows[i][p]} * double{rows[j][p]};
      products[i * n + j] = products[j * n + i] = sum;
    }
  }
  return products;
}

double over_standard_error(double excess, double standard_error) {
  if (!(excess > 0)) return std::isnan(excess) ? excess : 0;
  return standard_error > 0 ? excess / standard_error : std::numeric_limits<double>::infinity();
}

// `allowed`: |d|^2 of a difference that is none. The scatter of products is taken from rows about their mean,
// so that a difference does not hide behind itself.
double local_difference(const SeedRows& rows, double allowed) {
  const std::size_t n = rows.size();
  const double count = static_cast<double>(n), pairs = count * (count - 1);
  const std::vector<double> h = products_of(rows);
  std::vector<double> row_mean(n);
  double all = 0, trace = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) row_mean[i] += h[i * n + j] / count;
    all += row_mean[i] / count;
    trace += h[i * n + i];
  }
  const double mean = (all * count * count - trace) / pairs;
  double own = 0, between = 0, between2 = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double centred = h[i * n + j] - row_mean[i] - row_mean[j] + all;
      if (i == j) own += centred;
      if (i != j) between += centred, between2 += centred * centred;
    }
  }
  const double variance = std::max(between2 / pairs - (between / pairs) * (between / pairs), 0.0);
  const double scatter = own / (count - 1), excess = mean - allowed;
  if (variance == 0) return over_standard_error(excess, 0);
  // As many independent values of equal scatter would scatter like these.
  const double degrees = std::max(1.0, scatter * scatter / variance);
  return std::max(0.0, normal_from_f(1 + count * excess / scatter, degrees, (count - 1) * degrees));
}

}  // namespace

double mean_of(const SeedRows& rows) {
  double sum = 0, count = 0;
  for (const auto& row : rows) {
    sum = std::accumulate(row.begin(), row.end(), sum);
    count += static_cast<double>(row.size());
  }
  return count > 0 ? sum / count : 0;
}

MeanDifference mean_difference(const SeedRows& tested, const SeedRows& reference, double rounding) {
  const std::size_t n = tested.size();
  if (n < 3 || reference.size() != n) throw std::invalid_argument("rows of too few seeds");
  for (std::size_t i = 0; i < n; ++i) {
    if (tested[i].size() != tested[0].size() || reference[i].size() != tested[0].size())
      throw std::invalid_argument("rows of two lengths");
  }
  if (!std::isfinite(mean_of(tested)) || !std::isfinite(mean_of(reference)))
    return {kNotMeasured, kNotMeasured, kNotMeasured};
  double allowed2 = 0, allowed = 0;
  const std::vector<double> expected = mean_row(reference);
  for (const double value : expected) {
    allowed2 += rounding * value * rounding * value;
    allowed += rounding * std::abs(value);
  }
  const SeedRows rows = differences(tested, reference);
  const double count = static_cast<double>(n);
  const auto values = static_cast<double>(std::max<std::size_t>(1, expected.size()));
  std::vector<double> means(n);
  for (std::size_t i = 0; i < n; ++i)
    means[i] = std::accumulate(rows[i].begin(), rows[i].end(), 0.0) / values;
  const double mean = std::accumulate(means.begin(), means.end(), 0.0) / count;
  double variance = 0;
  for (const double m : means) variance += (m - mean) * (m - mean) / (count - 1);
  MeanDifference out;
  out.local = local_difference(rows, allowed2);
  out.overall = normal_from_t(
      over_standard_error(std::abs(mean) - allowed / values, std::sqrt(variance / count)), count - 1);
  const double reference_mean = mean_of(reference);
  out.share = reference_mean != 0 ? mean / reference_mean : 0;
  return out;
}

SeedNoise seed_noise(const SeedRows& rows) {
  const auto count = static_cast<double>(rows.size());
  const std::vector<double> mean = mean_row(rows);
  // Each row's squared distance from the mean is one estimate of the variance.
  std::vector<double> estimate(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t p = 0; p < mean.size(); ++p) {
      const double apart = double{rows[i][p]} - mean[p];
      estimate[i] += apart * apart * count / (count - 1) / static_cast<double>(mean.size());
    }
  }
  const double variance = std::accumulate(estimate.begin(), estimate.end(), 0.0) / count;
  double scatter = 0;
  for (const double e : estimate) scatter += (e - variance) * (e - variance) / (count - 1);
  SeedNoise out;
  out.sigma = std::sqrt(variance);
  if (out.sigma > 0) out.standard_error = std::sqrt(scatter / count) / (2 * out.sigma);
  return out;
}

double normal_from_f(double f, double degrees, double degrees_below) {
  const double root = std::cbrt(std::max(f, 0.0)), a = 2 / (9 * degrees), b = 2 / (9 * degrees_below);
  return ((1 - b) * root - (1 - a)) / std::sqrt(a + root * root * b);
}

double normal_from_t(double t, double degrees) {
  return (8 * degrees + 1) / (8 * degrees + 3) * std::sqrt(degrees * std::log1p(t * t / degrees));
}

}  // namespace herr
