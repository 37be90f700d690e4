#include "server/synth/smooth_noise.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "server/synth/seeded_random.h"

namespace herr {
namespace {}  // namespace

SmoothNoise::SmoothNoise(std::uint64_t seed, std::uint64_t stream, double amplitude, double lowest_hz,
                         double highest_hz) {
  SeededRandom random(seed, stream);
  const double band_hz = (highest_hz - lowest_hz) / kWaves;
  double total = 0;
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    Wave& wave = waves_[i];
    wave.hz = lowest_hz + band_hz * (static_cast<double>(i) + random.uniform(0, 1));
    wave.amplitude = 1.0 / wave.hz;  // slow waves are large: speeds stay even over the band
    wave.phase_rad = random.uniform(0, kTwoPi);
    total += wave.amplitude;
  }
  for (Wave& wave : waves_) wave.amplitude *= amplitude / total;
}

double SmoothNoise::operator()(double time_s) const {
  double sum = 0;
  for (const Wave& wave : waves_)
    sum += wave.amplitude * std::sin(kTwoPi * wave.hz * time_s + wave.phase_rad);
  return sum;
}

}  // namespace herr
