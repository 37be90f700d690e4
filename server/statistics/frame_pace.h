// How even the frames of a run are: stutter, and the three frame rates that people call "1 % low".
// Before: frame times. After: FrameStep marks frames that stutter, quality_json reports.
#pragma once

#include "server/statistics/latency_histogram.h"

namespace herr {

// Frames that take more than kFactor times the mean of those before them in their run, in order of time. The
// mean is exponential in the time that the frames took: mean' = t + (mean - t) exp(-t / 1 s). The verdict
// stays with the frame (FrameRecord::stutter), so that runs merge exactly.
class StutterWatch {
 public:
  static constexpr double kFactor = 2.5;
  static constexpr double kMean_s = 1.0;

  // True if this frame, the next one of the run, stutters.
  bool next_ms(double frame_ms);

 private:
  double mean_ms_ = 0;  // 0: no frame yet
};

// Frames per second; 0 when there is none. All of frame times alone: waiting for a display does not count.
struct OnePercentLows {
  double rank_fps = 0;  // 1 / the time that 99 % of the frames do not exceed
  double mean_fps = 0;  // 1 / the mean of the slowest 1 % of the frames (one at least)
  double time_fps = 0;  // 1 / the shortest of the slowest frames that together took 1 % of the time
};
OnePercentLows one_percent_lows(const LatencyHistogram& frame_times);

}  // namespace herr
