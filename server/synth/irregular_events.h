// Things that happen now and then and last a while: blinks, and hitches of the recording program. Before: the
// seed. After: synth_streams leaves rows out or closes the eyes.
#pragma once

#include <cstdint>
#include <optional>

#include "server/synth/seeded_random.h"

namespace herr {

// Not thread-safe: times never decrease. Memory does not grow with time. Two with the same arguments agree.
class IrregularEvents {
 public:
  struct Config {
    double per_minute = 0;                 // 0: none
    double shortest_s = 0, longest_s = 0;  // how long one lasts; log-uniform
    double quiet_start_s = 0;              // none before this time
    double least_pause_s = 0;              // between two; beyond it pauses are exponential
  };
  IrregularEvents(const Config& config, std::uint64_t seed, std::uint64_t stream);

  // How much of the event at this time is over, in [0, 1); none between events.
  std::optional<double> share_at(double time_s);
  std::int64_t count() const { return count_; }  // that some share_at() met

 private:
  void plan_next(double after_s);

  Config config_;
  SeededRandom random_;
  double start_s_ = 0, length_s_ = 0;  // of the present or next event
  bool met_ = false;
  std::int64_t count_ = 0;
};

// Highest rate of the two below.
inline constexpr double kMostPerMinute = 60;

// 15-17 a minute at rest, at irregular times (A. R. Bentivoglio et al., Analysis of blink rate patterns in
// normal subjects, Movement Disorders 12, 1997), 0.15-0.3 s each.
IrregularEvents blinks(std::uint64_t seed, double per_minute);
// Openness of the lids after this share of a blink, 1 open ... 0 closed: down in a third of it, up in a half.
double lid_openness(std::optional<double> blink_share);
// A tracker sees no pupil behind lids that are half closed.
inline constexpr double kLeastSeenOpenness = 0.5;

// Rows of every stream are missing for 40-350 ms, as in real recordings (Schuetz et al., J. Vision 24(7):10,
// 2024). The first second is whole.
IrregularEvents hitches(std::uint64_t seed, double per_minute);

}  // namespace herr
