#include "server/study/error/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace herr {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

constexpr std::array<MetricRow, kMetrics> kMetricRows{{
    {"rmse", "RMSE",
     "The root of the mean of d² over pixels and colour channels, in linear light limited to [0, 1].",
     "Where an error stands, whether it has structure, and how dark the place is.", 0.5},
    {"relative_mse", "relative MSE", "The mean of d² / (reference² + 0.01) over pixels and colour channels.",
     "How bright a place is: dark ones count as much as bright ones, also where nobody can see it.", 0.25},
    {"p99_9", "99.9th percentile",
     "The value that 99.9 % of pixels do not exceed, each with the largest |d| of its channels.",
     "All but one value: nothing of how the other errors are spread.", 0.5},
    {"largest", "largest", "The largest |d| of all pixels and channels.",
     "All but one value: it is that of a single pixel, and grows with the number of pixels.", 0.5},
    {"psnr_db", "PSNR (dB)", "-20 log10(RMSE): white is the peak.", "The same as the RMSE.", 0},
    {"acuity_rmse", "acuity-weighted RMSE",
     "The root of the mean of d² over pixels and colour channels. d is low-passed by a Gaussian that halves "
     "the "
     "eye's limit at its eccentricity e in degrees, f = 2.3 ln 64 / (0.106 (e + 2.3)) cycles per degree "
     "(Geisler & "
     "Perry 1998); a pixel weighs its solid angle times (2 f)², the samples that the eye needs there.",
     "Contrast and masking: whatever the eye can resolve counts by its light alone.", 0.5},
    // FLIP's colour difference is HyAB to the power 0.7, so half a difference has 0.5^0.7 of it.
    {"flip", "FLIP",
     "The mean over pixels of LDR-FLIP with the pixels per degree of the viewport's middle row.",
     "Eccentricity: it takes each pixel as if looked at.", 0.61557220667245813},
}};

double psnr_db(double rmse) {
  return rmse > 0 ? -20 * std::log10(rmse) : kNone;
}

// How frames become one value.
enum class Over { mean, root_of_mean_square, largest, from_rmse };

Over over(Metric metric) {
  switch (metric) {
    case Metric::rmse:
    case Metric::acuity_rmse:
      return Over::root_of_mean_square;
    case Metric::p99_9:
    case Metric::largest:
      return Over::largest;
    case Metric::psnr_db:
      return Over::from_rmse;
    case Metric::relative_mse:
    case Metric::flip:
      break;
  }
  return Over::mean;
}

double value_over(std::span<const ErrorTable> frames, Metric metric, std::size_t band) {
  const Over how = over(metric);
  double sum = 0, largest = 0;
  int count = 0;
  for (const ErrorTable& frame : frames) {
    const double value = frame.at(metric, band);
    if (std::isnan(value)) continue;
    sum += how == Over::root_of_mean_square ? value * value : value;
    largest = std::max(largest, value);
    ++count;
  }
  if (count == 0) return kNone;
  if (how == Over::largest) return largest;
  return how == Over::root_of_mean_square ? std::sqrt(sum / count) : sum / count;
}

}  // namespace

std::span<const MetricRow, kMetrics> metric_rows() {
  return kMetricRows;
}

ErrorTable::ErrorTable() {
  for (auto& row : value) row.fill(kNone);
}

ErrorTable error_of_mean(const ErrorTable& between_halves) {
  ErrorTable result;
  for (std::size_t band = 0; band < kBands; ++band) {
    for (std::size_t m = 0; m < kMetrics; ++m)
      result.value[band][m] = kMetricRows[m].of_halves * between_halves.value[band][m];
    result.value[band][static_cast<std::size_t>(Metric::psnr_db)] = psnr_db(result.at(Metric::rmse, band));
  }
  return result;
}

ErrorTable over_frames(std::span<const ErrorTable> frames) {
  ErrorTable result;
  for (std::size_t band = 0; band < kBands; ++band) {
    for (std::size_t m = 0; m < kMetrics; ++m) {
      const auto metric = static_cast<Metric>(m);
      result.value[band][m] = over(metric) == Over::from_rmse ? psnr_db(result.at(Metric::rmse, band))
                                                              : value_over(frames, metric, band);
    }
  }
  return result;
}

}  // namespace herr
