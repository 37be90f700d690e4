// Head of a person who stands and shifts about in a room: smooth, band-limited, a pure function of seed and
// time. Before: the seed. After: pose/data.csv, and the camera that looks from there.
#pragma once

#include <array>
#include <cstdint>

#include "sessions/pose.h"

namespace herr {

// A sum of a few sine waves: band-limited by construction, so that any sampling rate above 6 Hz resolves it.
class SmoothNoise {
 public:
  static constexpr int kWaves = 4;
  SmoothNoise() = default;
  // Frequencies spread over [lowest_hz, highest_hz]; |value| <= amplitude.
  SmoothNoise(std::uint64_t seed, std::uint64_t stream, double amplitude, double lowest_hz,
              double highest_hz);
  double operator()(double time_s) const;

 private:
  struct Wave {
    double amplitude = 0, hz = 0, phase_rad = 0;
  };
  std::array<Wave, kWaves> waves_{};
};

class HeadMotion {
 public:
  explicit HeadMotion(std::uint64_t seed);
  // World from head at any time. Near (0, 1.5, 3.7) m, looking along -Z within about 10 degrees.
  Pose at(double time_s) const;

 private:
  std::array<SmoothNoise, 3> sway_;  // metres
  std::array<SmoothNoise, 3> turn_;  // degrees: yaw, pitch, roll
  double step_phase_rad_ = 0;
};

}  // namespace herr
