// A band-limited wobble: a sum of a few sine waves, a pure function of seed and time. Before: the seed.
// After: head_motion adds it to positions and angles.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>

namespace herr {

inline constexpr double kTwoPi = 2.0 * std::numbers::pi;

// Any sampling rate above twice the highest frequency resolves it.
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

}  // namespace herr
