// How well the eyes were tracked: lost pupils, blinks, and how far from the head's axis they look. Constant
// memory. Before: gaze rows in order. After: findings, the plot of gaze eccentricity.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "sessions/inspect/findings.h"
#include "sessions/inspect/meters/linear_histogram.h"
#include "sessions/inspect/time_profile.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

class GazeMeter {
 public:
  // `rows` stands at the row.
  void add(const GazeRow& row, const CsvRows& rows);
  // After the last row.
  void finish();
  void judge(const std::filesystem::path& file, FindingList& findings) const;

  std::int64_t rows() const { return rows_; }
  std::int64_t lost_rows() const { return lost_rows_; }  // neither eye
  std::int64_t either_lost_rows() const { return lost_rows_of_[0] + lost_rows_of_[1] - lost_rows_; }
  std::int64_t lost_rows_of(std::size_t eye) const { return lost_rows_of_[eye]; }
  std::int64_t off_axis_rows() const { return off_axis_rows_; }  // said to be valid, more than 60 degrees off
  double lost_share() const;                                     // of the rows, 0 to 1
  // Spans without either eye: those of at most kGazeHoldNs are blinks, across which replay holds the gaze.
  std::int64_t blinks() const { return blinks_; }
  std::int64_t losses() const { return losses_; }
  TimeNs longest_loss_ns() const { return longest_loss_ns_; }
  std::int64_t longest_loss_line() const { return longest_loss_line_; }  // its first row
  double worst_norm_error() const { return worst_norm_error_; }
  // Angle between the gaze and the head's axis, the mean of the valid eyes.
  const LinearHistogram& eccentricity_deg() const { return eccentricity_deg_; }
  const TimeProfile& eccentricity_profile() const { return eccentricity_profile_; }

 private:
  void end_loss(TimeNs end_ns);

  std::int64_t rows_ = 0, lost_rows_ = 0, off_axis_rows_ = 0, blinks_ = 0, losses_ = 0;
  std::array<std::int64_t, 2> lost_rows_of_{};
  std::int64_t first_off_axis_line_ = 0, last_off_axis_line_ = 0;
  std::optional<TimeNs> lost_since_ns_;
  std::int64_t lost_since_line_ = 0;
  TimeNs last_ns_ = 0, longest_loss_ns_ = 0;
  std::int64_t longest_loss_line_ = 0;
  double worst_norm_error_ = 0;
  LinearHistogram eccentricity_deg_{0.1, 900};
  TimeProfile eccentricity_profile_;
};

}  // namespace herr
