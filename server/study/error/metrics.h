// The measures of error that a study states, in a list: CSV, JSON, tables and diagrams go over it.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "server/study/error/viewport_map.h"

namespace herr {

enum class Metric : std::size_t { rmse, relative_mse, p99_9, largest, psnr_db, acuity_rmse, flip };
inline constexpr std::size_t kMetrics = 7;

struct MetricRow {
  const char* name;      // key: "rmse"
  const char* label;     // "RMSE"
  const char* sentence;  // its formula, ends with a full stop
  const char* blind_to;  // what it does not see, ends with a full stop
  // The reference is the mean of two halves: its own error is this times the metric of one half against the
  // other (1/2 where the metric grows with the difference, 1/4 where it grows with its square, 0.5^0.7 for
  // FLIP, whose colour difference grows with that power). 0: derived from the RMSE (PSNR).
  double of_halves;
};
std::span<const MetricRow, kMetrics> metric_rows();

// Metric by band, [band][metric]. NaN where a band has no pixel, and PSNR of equal pictures.
struct ErrorTable {
  std::array<std::array<double, kMetrics>, kBands> value;
  ErrorTable();  // all NaN
  double at(Metric metric, std::size_t band = kAllPixels) const {
    return value[band][static_cast<std::size_t>(metric)];
  }
};

// The error of the mean of two halves, from the metrics of one half against the other.
ErrorTable error_of_mean(const ErrorTable& between_halves);

// Over several frames: squared measures by their mean, p99.9 and largest by the largest, FLIP by the mean,
// PSNR from the RMSE. Frames without a value are left out.
ErrorTable over_frames(std::span<const ErrorTable> frames);

}  // namespace herr
