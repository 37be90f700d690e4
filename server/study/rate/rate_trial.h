// One measurement of one setting, and what the machine gave to it. Before: RateSubject renders. After:
// RateSearch decides by the percentile alone; the report tells the rest.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/stage_times.h"

namespace herr {

// Of the frames of one measurement, or of several together.
struct MachineUse {
  double cpu_ms = 0;      // of the process during the frames
  double cores_ms = 0;    // that the frames' threads could have had: wall time x threads, no more than cores
  bool cpu_known = true;  // the kernel told it of all frames
  std::int64_t preemptions = 0;
  std::int64_t late = 0, late_by_machine = 0;     // statistics/miss_cause.h
  std::int64_t used_ticks = 0, stolen_ticks = 0;  // of the whole machine, as the hypervisor took them

  void add(const MachineUse& other);
  std::optional<double> cpu_share() const;
  double steal() const;
  // The machine, not the work, made frames late, or threads waited for cores that others had.
  bool busy() const;
  // What of that was measured, for a warning.
  std::string text() const;
};

// Frames that follow one another in the session.
struct RateStretch {
  double from_s = 0, to_s = 0;  // since the session's start: its first frame, one period after its last
  int frames = 0;               // measured
  double p95_ms = 0;
};

struct RateTrial {
  int frames = 0;  // measured; those that warm up are not counted
  // Of whole frames, sampling of the session included: of the heaviest stretch (worst_stretch), or of all
  // frames together where that is more.
  double p95_ms = 0;
  double all_p95_ms = 0;  // of all frames together
  // As p95_ms, of frames less what their threads waited (free_frame_ms); none where CPU times are not known.
  std::optional<double> free_p95_ms;
  std::vector<RateStretch> stretches;  // that frames were measured in; in the session's order
  bool cut_short = false;  // given up, since more than a twentieth of the frames asked for were late already
  bool hopeless = false;   // given up, since each of its frames took more than kHopelessTimes the period
  double frame_ms = 0;     // mean
  double sample_ms = 0;    // of it: sampling the session, camera pictures decoded
  StageTimes stages;       // of it: means
  MachineUse machine;
  // Means of the eye that reaches less (FrameRecord); none without polar buffers.
  std::optional<double> k_radial, k_angular;
};

// A setting that misses by more is not measured again in the hope of better.
inline constexpr double kHopelessTimes = 3;

// Of the stretches that have kFewestOfStretch frames the one with the largest percentile; null: none has.
inline constexpr int kFewestOfStretch = 20;  // their 95th percentile has one above it
const RateStretch* worst_stretch(const RateTrial& trial);

// Roughly what a frame takes while nobody else has its cores: its rendering takes its CPU time spread evenly
// over `cores`, which no frame does quite, and no longer than it did. What is beside it stays, sampling above
// all.
double free_frame_ms(double frame_ms, double render_ms, double cpu_ms, int cores);

// Nearest rank: the smallest that 95 % do not exceed. Of at least one time.
double percentile_95(std::span<const double> times_ms);

}  // namespace herr
