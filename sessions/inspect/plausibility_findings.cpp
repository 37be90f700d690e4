// The warnings of plausibility.h.
#include <algorithm>
#include <cmath>

#include "sessions/inspect/attitude_findings.h"
#include "sessions/inspect/number_words.h"
#include "sessions/inspect/plausibility.h"
#include "sessions/inspect/plausibility_words.h"
#include "sessions/text/fixed_text.h"

namespace herr {
namespace {

constexpr double kMostRows = 0.5;
// A person's eyes rest in the head while it turns only where something turns along with the head.
constexpr std::int64_t kFewestTurns = 50;
constexpr double kAlwaysResting = 0.9;

void tell(Severity severity, const std::filesystem::path& file, const std::string& problem,
          const std::string& remedy, FindingList& findings) {
  findings.add(severity, InputError(file, 0, problem, remedy));
}

}  // namespace

void PlausibilityMeter::judge(const std::filesystem::path& pose_file, const std::filesystem::path& gaze_file,
                              FindingList& findings) const {
  if (attitude_.rows() >= kFewestRows) {
    herr::judge_attitude(attitude_, pose_file, findings);
    judge_speed(pose_file, findings);
    judge_stillness(pose_file, findings);
  }
  if (eyes_.rows_with_gaze() >= kFewestRows) {
    judge_eyes(gaze_file, findings);
    judge_countering(gaze_file, findings);
  }
  judge_steadiness(pose_file, gaze_file, findings);
}

void PlausibilityMeter::judge_speed(const std::filesystem::path& file, FindingList& findings) const {
  const double fast = figures().fast_share.value_or(0);
  if (fast <= kMostRows) return;
  tell(Severity::warning, file, "the head goes faster than 10 m/s in " + percents(fast) + " of the rows",
       "unless it was driven, positions are millimetres or centimetres (\"unit\" of the map's position), or "
       "stamps "
       "have another unit",
       findings);
}

void PlausibilityMeter::judge_stillness(const std::filesystem::path& file, FindingList& findings) const {
  if (still_head_meant_) return;
  const std::string in_all = " to the last digit in all " + std::to_string(attitude_.rows()) + " rows";
  if (!attitude_.turns() && !attitude_.moves())
    tell(Severity::warning, file, "the head stands still" + in_all,
         "the tracker was dead, or these columns are not the head's", findings);
  else if (!attitude_.turns())
    tell(Severity::warning, file, "the head moves, but its orientation stands still" + in_all,
         "the orientation was not tracked, or its columns are others", findings);
  else if (!attitude_.moves())
    tell(Severity::note, file, "the head turns, but its position stands still" + in_all,
         "a tracker of rotation alone (3 degrees of freedom) shows no parallax", findings);
}

void PlausibilityMeter::judge_eyes(const std::filesystem::path& file, FindingList& findings) const {
  const PlausibilityFigures known = figures();
  if (known.off_axis_share.value_or(0) > kMostRows)
    tell(Severity::warning, file,
         "the gaze is more than 60 degrees off the head's axis in " + percents(*known.off_axis_share) +
             " of the rows, " + whole(known.median_gaze_deg) + " degrees in the median",
         known.median_gaze_deg > 120
             ? "it looks backwards: z is turned round, or the axes of the gaze are others"
             : "the axes of the gaze are others than the map says, or the gaze is in the "
               "world's axes",
         findings);
  if (!eyes_.changes() && !still_gaze_meant_)
    tell(Severity::warning, file,
         "the gaze never changes, to the last digit, in " + std::to_string(eyes_.rows_with_gaze()) + " rows",
         "the eye tracker was dead or off, or these columns are not the gaze", findings);
  else if (known.same_ray_share.value_or(0) > kMostRows)
    tell(Severity::warning, file,
         "both eyes hold the same ray in " + percents(*known.same_ray_share) + " of the rows",
         "the tracker wrote one combined ray for both eyes: their own rays were not recorded", findings);
  if (known.diverging_share.value_or(0) <= kMostRows) return;
  // Eyes that counter the head sideways are not mirrored.
  const bool counters = known.evidence_x > 0;
  tell(counters ? Severity::note : Severity::warning, file,
       "the eyes diverge by more than 1 degree in " + percents(*known.diverging_share) + " of the rows",
       counters ? "people's do not: left and right are exchanged, or the tracker was not calibrated"
                : "people's do not: the gaze is mirrored sideways (x), or left and right are exchanged",
       findings);
}

void PlausibilityMeter::judge_countering(const std::filesystem::path& file, FindingList& findings) const {
  const GazeCountering::Axis &x = countering_.horizontal(), &y = countering_.vertical();
  if (still_gaze_meant_) return;
  const bool reversed_x = x.reversed(), reversed_y = y.reversed();
  const bool reversed = reversed_x || reversed_y || countering_.reversed_on_both();
  const std::int64_t turns = countering_.turning_windows(), resting = countering_.resting_windows();
  if (reversed) {
    const bool two = reversed_x == reversed_y;
    const std::int64_t with = two ? x.with + y.with : reversed_x ? x.with : y.with;
    const std::int64_t telling = two ? x.telling() + y.telling() : reversed_x ? x.telling() : y.telling();
    const std::string way = two ? "" : reversed_x ? " sideways" : " up and down";
    tell(Severity::warning, file,
         "while the head turns" + way + ", the eyes turn with it in " +
             percents(static_cast<double>(with) / static_cast<double>(std::max<std::int64_t>(1, telling))) +
             " of " + std::to_string(telling) +
             " windows; people's turn against it, to keep looking at one thing",
         std::string("the gaze is mirrored") +
             (two          ? ""
              : reversed_x ? " sideways (x)"
                           : " up and down (y)") +
             ", or the head is (handedness, axes)",
         findings);
  } else if (countering_.exchanged()) {
    tell(Severity::warning, file,
         "while the head turns sideways, the eyes turn up or down, and the other way about; people's turn "
         "against "
         "it, to keep looking at one thing",
         "the two axes of the gaze are exchanged, or those of the head", findings);
  } else if (turns >= kFewestTurns &&
             static_cast<double>(resting) > kAlwaysResting * static_cast<double>(turns)) {
    tell(Severity::note, file,
         "the eyes rest in the head in " + percentage(resting, turns) +
             " of the moments at which it turns; people's turn against it, to keep looking at one thing",
         "the gaze was not tracked, or was written in the world's axes", findings);
  }
}

void PlausibilityMeter::judge_steadiness(const std::filesystem::path& pose_file,
                                         const std::filesystem::path& gaze_file,
                                         FindingList& findings) const {
  const auto tell_lines = [&](const std::filesystem::path& file, const std::optional<double>& hz) {
    if (!hz) return false;
    tell(Severity::note, file,
         "the rows lie on straight lines between samples at about " + fixed_text(*hz, 1) + " Hz",
         "a slower log was resampled: what was measured is rarer than the rows", findings);
    return true;
  };
  const std::optional<double> way_hz = way_.knots_hz();
  tell_lines(pose_file, way_hz ? way_hz : turn_.knots_hz());
  if (tell_lines(gaze_file, gaze_turn_.knots_hz())) return;
  if (jumps_.dulled())
    tell(Severity::note, gaze_file,
         "the eyes do not stop abruptly after jumps, as eyes do, but slow down over many rows",
         "the gaze was smoothed: it lags behind and its jumps are dulled", findings);
}

}  // namespace herr
