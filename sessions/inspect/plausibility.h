// Does a recording, in our axes, look like a person's head and eyes? Where the head looks, how level it is, whether
// it moves at all, whether the eyes converge, whether gaze counters the head as people's does, whether a stream
// repeats or smooths its rows. Wrong axes, mirrored gaze and dead trackers show here, and only here.
// Bounded memory. Before: rows in order, all poses first, then the gaze. After: findings of `herr inspect` and
// `herr convert`; the choice between siblings of a format; `herr convert --check`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sessions/inspect/findings.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

// Shares are of the rows that could be judged, 0 to 1; none where there were too few.
struct PlausibilityFigures {
  std::int64_t pose_rows = 0, gaze_rows = 0;
  std::optional<double> level_share;      // the head's up lies within 60 degrees of the world's
  double median_tilt_deg = 0;             // between the head's up and the world's
  double median_roll_deg = 0, median_pitch_deg = 0;  // absolute roll; pitch, positive up
  double up_spread_deg = 0;               // of the head's up in the world about its mean: a steady up is a true one
  bool head_turns = false, head_moves = false;  // at all, to the last digit
  std::optional<double> diverging_share;  // the eyes' rays diverge by more than 1 degree
  std::optional<double> same_ray_share;   // per-eye gaze: both rays are equal to the last digit
  std::optional<double> off_axis_share;   // more than 60 degrees from the head's forward
  double median_gaze_deg = 0;             // from the head's forward
  // While the head turns: how often the eyes turn against it, horizontally and vertically. People's do in most
  // windows; mirrored gaze in few; gaze that knows nothing of the head in half of them.
  std::optional<double> countering_x, countering_y;
  std::int64_t countering_windows = 0;
};

class PlausibilityMeter {
 public:
  void add(const PoseRow& row);
  // `per_eye`: the rays are those of each eye.
  void add(const GazeRow& row, bool per_eye);
  void finish();

  PlausibilityFigures figures() const;
  // One or two sentences in words: where the head looks, which way is up, how level it is.
  std::string words() const;
  // Warnings that name the likely cause and what to do; files are those of the findings.
  void judge(const std::filesystem::path& pose_file, const std::filesystem::path& gaze_file,
             FindingList& findings) const;
};

}  // namespace herr
