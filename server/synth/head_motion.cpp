#include "server/synth/head_motion.h"

#include <cmath>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "server/synth/seeded_random.h"

namespace herr {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr glm::dvec3 kStandingAt{0.0, 1.5, 3.7};
constexpr double kLookingDownDeg = 12.0;  // towards things on tables and floor
// A slow walk: two steps a second move the head up and down by 1.5 cm, each pair of steps sideways by 1 cm.
constexpr double kStepHz = 1.8, kStepHeightM = 0.015, kStepWidthM = 0.01;

}  // namespace

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

HeadMotion::HeadMotion(std::uint64_t seed)
    : sway_{SmoothNoise(seed, 0, 0.15, 0.1, 0.6), SmoothNoise(seed, 1, 0.03, 0.1, 0.6),
            SmoothNoise(seed, 2, 0.20, 0.1, 0.6)},
      turn_{SmoothNoise(seed, 3, 8.0, 0.15, 1.5), SmoothNoise(seed, 4, 4.0, 0.15, 1.5),
            SmoothNoise(seed, 5, 1.5, 0.15, 1.5)} {
  step_phase_rad_ = SeededRandom(seed, 6).uniform(0, kTwoPi);
}

Pose HeadMotion::at(double time_s) const {
  const double step_rad = kTwoPi * kStepHz * time_s + step_phase_rad_;
  Pose pose;
  pose.position =
      kStandingAt + glm::dvec3{sway_[0](time_s) + kStepWidthM * std::sin(step_rad / 2),
                               sway_[1](time_s) + kStepHeightM * std::sin(step_rad), sway_[2](time_s)};
  const glm::dquat yaw = glm::angleAxis(glm::radians(turn_[0](time_s)), glm::dvec3{0, 1, 0});
  const glm::dquat pitch =
      glm::angleAxis(glm::radians(turn_[1](time_s) - kLookingDownDeg), glm::dvec3{1, 0, 0});
  const glm::dquat roll = glm::angleAxis(glm::radians(turn_[2](time_s)), glm::dvec3{0, 0, 1});
  pose.orientation = glm::normalize(yaw * pitch * roll);
  return pose;
}

}  // namespace herr
