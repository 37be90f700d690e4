#include "sessions/inspect/gaze_meter.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <string>
#include <utility>

#include "sessions/inspect/number_words.h"
#include "sessions/streams/gaze_sampler.h"

namespace herr {
namespace {

constexpr double kMuchLost = 0.2;  // people blink for 2 to 5 % of the time
constexpr double kOftenOneEye = 0.2;

double off_axis_deg(const glm::dvec3& d) {
  return glm::degrees(std::atan2(std::hypot(d.x, d.y), -d.z));
}

}  // namespace

void GazeMeter::add(const GazeRow& row, const CsvRows& rows) {
  ++rows_;
  last_ns_ = row.stamp_ns;
  double sum_deg = 0;
  int seen = 0;
  bool off_axis = false;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const std::size_t first = 1 + 4 * eye;
    if (rows.flag(first + 3)) {
      const double norm = std::hypot(rows.number(first), rows.number(first + 1), rows.number(first + 2));
      worst_norm_error_ = std::max(worst_norm_error_, std::abs(norm - 1));
      off_axis = off_axis || !row.valid[eye];
    }
    if (!row.valid[eye]) {
      ++lost_rows_of_[eye];
      continue;
    }
    sum_deg += off_axis_deg(row.head_direction[eye]);
    ++seen;
  }
  if (off_axis) {
    if (off_axis_rows_++ == 0) first_off_axis_line_ = rows.line();
    last_off_axis_line_ = rows.line();
  }
  if (seen > 0) {
    end_loss(row.stamp_ns);
    eccentricity_deg_.add(sum_deg / seen);
    eccentricity_profile_.add(row.stamp_ns, sum_deg / seen);
    return;
  }
  ++lost_rows_;
  eccentricity_profile_.add(row.stamp_ns, std::nullopt);
  if (lost_since_ns_) return;
  lost_since_ns_ = row.stamp_ns;
  lost_since_line_ = rows.line();
}

void GazeMeter::end_loss(TimeNs end_ns) {
  if (!lost_since_ns_) return;
  const TimeNs length_ns = end_ns - *lost_since_ns_;
  ++(length_ns <= kGazeHoldNs ? blinks_ : losses_);
  if (length_ns >= longest_loss_ns_) {
    longest_loss_ns_ = length_ns;
    longest_loss_line_ = lost_since_line_;
  }
  lost_since_ns_.reset();
}

void GazeMeter::finish() {
  end_loss(last_ns_);
}

double GazeMeter::lost_share() const {
  return rows_ > 0 ? static_cast<double>(lost_rows_) / static_cast<double>(rows_) : 0;
}

void GazeMeter::judge(const std::filesystem::path& file, FindingList& findings) const {
  if (rows_ == 0) return;
  if (lost_rows_ > 0) {
    const std::string spans = counted(blinks_, "blink", "blinks") + ", " +
                              counted(losses_, "loss", "losses") + " of more than 600 ms";
    findings.add({losses_ > 0 || lost_share() > kMuchLost ? Severity::warning : Severity::note,
                  InputError(file, longest_loss_line_,
                             percentage(lost_rows_, rows_) + " of the rows have no gaze (" + spans +
                                 "); the longest span, " + milliseconds(longest_loss_ns_) + ", begins here",
                             lost_rows_ == rows_ ? "the eyes look straight ahead; the tracker saw no pupil"
                                                 : "it is held for 600 ms, then glides to the centre"),
                  false, 1});
  }
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const std::int64_t alone = lost_rows_of_[eye] - lost_rows_;
    if (static_cast<double>(alone) <= kOftenOneEye * static_cast<double>(rows_)) continue;
    findings.add(Severity::warning,
                 InputError(file, 0,
                            std::string("the ") + (eye == 0 ? "left" : "right") + " eye alone is lost in " +
                                percentage(alone, rows_) + " of the rows, one or both in " +
                                percentage(either_lost_rows(), rows_),
                            "the gaze is that of the other eye"));
  }
  if (off_axis_rows_ > 0)
    findings.add(
        {Severity::note,
         InputError(file, first_off_axis_line_, "the gaze is more than 60 degrees off the head's axis",
                    "it is taken for lost; check the axes if there are many"),
         false, off_axis_rows_, last_off_axis_line_});
}

}  // namespace herr
