// Does a recording, in our axes, look like a person's head and eyes? Where the head looks, how level it is,
// whether it moves at all, whether the eyes converge, whether gaze counters the head as people's does,
// whether a stream smooths its rows. Wrong axes, mirrored gaze and dead trackers show here, and only here.
// Bounded memory. Before: rows in order, all poses first, then the gaze. After: findings of `herr inspect`
// and `herr convert`; the choice between siblings of a format; `herr convert --check`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "sessions/inspect/findings.h"
#include "sessions/inspect/meters/attitude_meter.h"
#include "sessions/inspect/meters/eye_pair_meter.h"
#include "sessions/inspect/meters/gaze_countering.h"
#include "sessions/inspect/meters/gaze_jumps.h"
#include "sessions/inspect/meters/stream_steadiness.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

// Shares are of the rows that could be judged, 0 to 1; none where there were too few.
struct PlausibilityFigures {
  std::int64_t pose_rows = 0, gaze_rows = 0;
  std::optional<double> level_share;                 // the head's up lies within 60 degrees of the world's
  double median_tilt_deg = 0;                        // between the head's up and the world's
  double median_roll_deg = 0, median_pitch_deg = 0;  // absolute roll; pitch, positive up
  // Of the head's up, right and forward in the world about their means, as the root mean square of the chord:
  // 0 for a head that never turns, at most 81. Heads turn about the true up more than about anything else: it
  // is the steady one.
  double up_spread_deg = 0, right_spread_deg = 0, forward_spread_deg = 0;
  glm::dvec3 mean_up{0.0}, mean_right{0.0}, mean_forward{0.0};  // in the world, as long as they are steady
  bool head_turns = false, head_moves = false;                  // at all, to the last digit
  std::optional<double> fast_share;       // of the intervals, in which the head goes faster than 10 m/s
  std::optional<double> forwards_share;   // of the way that is walked forwards or backwards
  std::optional<double> diverging_share;  // the eyes' rays diverge by more than 1 degree
  std::optional<double> same_ray_share;   // per-eye gaze: both rays are equal to the last digit
  std::optional<double> off_axis_share;   // more than 60 degrees from the head's forward
  double median_gaze_deg = 0;             // from the head's forward
  // While the head turns: how often the eyes turn against it, horizontally and vertically. People's do in
  // most windows; mirrored gaze in few; gaze that knows nothing of the head in half of them.
  std::optional<double> countering_x, countering_y;
  std::int64_t countering_windows = 0;
  // The same as evidence: standard deviations from chance. People's: above 0, and above 3 where there is
  // enough; below -3 it is reversed. To be compared between readings of one file: the true axes have the
  // largest sum.
  double evidence_x = 0, evidence_y = 0;
  std::optional<double>
      stop_share;  // of fast turns of the eyes, those that stop within a row: filters blur them
  // Below -3 the turns fit better with the two axes of the gaze exchanged; people's: above 3 where there is
  // enough.
  double evidence_not_exchanged = 0;
};

class PlausibilityMeter {
 public:
  static constexpr std::int64_t kFewestRows = 20;  // of which anything is judged

  void add(const PoseRow& row);
  // `per_eye`: the rays are those of each eye.
  void add(const GazeRow& row, bool per_eye);
  // What stands still to the last digit was meant to: it is no finding then.
  void expect_still_head() { still_head_meant_ = true; }
  void expect_still_gaze() { still_gaze_meant_ = true; }

  PlausibilityFigures figures() const;
  // Sentences without a full stop: where the head looks, which way is up, how level it is; what the eyes do.
  std::string words() const;
  std::string gaze_words() const;  // empty without gaze
  // Warnings that name the likely cause and what to do; files are those of the findings.
  void judge(const std::filesystem::path& pose_file, const std::filesystem::path& gaze_file,
             FindingList& findings) const;

 private:
  void judge_speed(const std::filesystem::path& file, FindingList& findings) const;
  void judge_stillness(const std::filesystem::path& file, FindingList& findings) const;
  void judge_eyes(const std::filesystem::path& file, FindingList& findings) const;
  void judge_countering(const std::filesystem::path& file, FindingList& findings) const;
  void judge_steadiness(const std::filesystem::path& pose_file, const std::filesystem::path& gaze_file,
                        FindingList& findings) const;

  AttitudeMeter attitude_;
  EyePairMeter eyes_;
  GazeCountering countering_;
  StreamSteadiness way_, turn_, gaze_turn_;
  GazeJumps jumps_;
  std::int64_t intervals_ = 0, fast_intervals_ = 0;  // fast: the head goes faster than any person
  std::optional<PoseRow> last_pose_;
  std::optional<GazeRow> last_gaze_;
  bool still_head_meant_ = false, still_gaze_meant_ = false;
};

}  // namespace herr
