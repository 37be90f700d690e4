// Where the eyes look in the head, and whether the two of them look at one thing. Constant memory.
// Before: gaze rows in order. After: plausibility.h, which judges.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "sessions/inspect/meters/linear_histogram.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

class EyePairMeter {
 public:
  // `per_eye`: the rays are those of each eye.
  void add(const GazeRow& row, bool per_eye);

  std::int64_t rows() const { return rows_; }
  // Rows with a direction, on the axis or off it; those whose rays are all more than kMaxGazeAngleDeg off.
  std::int64_t rows_with_gaze() const { return rows_with_gaze_; }
  std::int64_t off_axis_rows() const { return off_axis_rows_; }
  const LinearHistogram& off_axis_deg() const {
    return off_axis_deg_;
  }                                          // the mean of the eyes; of rows 4 ms apart
  bool changes() const { return changes_; }  // at all, to the last digit

  // Rows with both eyes of a per-eye recording: how many, and in how many both rays are one to the last
  // digit.
  std::int64_t paired_rows() const { return paired_rows_; }
  std::int64_t same_ray_rows() const { return same_ray_rows_; }
  // Of the paired rows with different rays, those within kTrustedDeg of the axis: further out trackers do not
  // know vergence. Diverging: the left eye looks more than kDivergingDeg further to the left than the right
  // one.
  std::int64_t judged_rows() const { return judged_rows_; }
  std::int64_t diverging_rows() const { return diverging_rows_; }
  static constexpr double kTrustedDeg = 30, kDivergingDeg = 1;

 private:
  void compare(const glm::dvec3& left, const glm::dvec3& right);

  std::int64_t rows_ = 0, rows_with_gaze_ = 0, off_axis_rows_ = 0;
  std::int64_t paired_rows_ = 0, same_ray_rows_ = 0, judged_rows_ = 0, diverging_rows_ = 0;
  TimeNs measured_ns_ = 0;
  LinearHistogram off_axis_deg_{0.5, 361};
  std::array<glm::dvec3, 2> first_{};
  bool changes_ = false;
};

}  // namespace herr
