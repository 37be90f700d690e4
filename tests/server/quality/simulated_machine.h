// A machine whose frames cost what a formula says, and a clock that nobody waits for.
// Before: a test states the load. After: DeadlinePolicy is told what each frame cost.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "server/quality/deadline_policy.h"

namespace herr::test {

// Milliseconds: fixed + columns * (column + light * samples) + probe * probes, all times `factor`.
struct Load {
  double fixed_ms = 0, column_ms = 0, light_ms = 0, probe_ms = 0;
  double factor = 1;  // of this frame: steps, noise
  int rows = 0;       // that a whole column has: a lower frame costs less; 0: the height costs nothing
};

// With heights: its samples as columns of `rows`.
inline double columns_of(const Load& load, const FrameQuality& quality) {
  if (load.rows == 0) return quality.polar_width;
  return static_cast<double>(quality.polar_width) * quality.polar_height / load.rows;
}

inline constexpr double kRaysPerColumn = 500, kRaysPerProbe = 64;

inline FrameCost cost_of(const Load& load, const FrameQuality& quality, TimeNs finished_ns,
                         double target_ms) {
  FrameCost cost;
  cost.quality = quality;
  cost.finished_ns = finished_ns;
  const auto set = [&](WorkKind kind, double units, double ms_per_unit, double rays_per_unit) {
    cost.work_ms[static_cast<std::size_t>(kind)] = load.factor * units * ms_per_unit;
    cost.rays[static_cast<std::size_t>(kind)] = std::llround(units * rays_per_unit);
  };
  const double columns = columns_of(load, quality);
  set(WorkKind::eye, columns, load.column_ms, kRaysPerColumn);
  set(WorkKind::light, columns * quality.light_samples, load.light_ms, kRaysPerColumn);
  set(WorkKind::probe, quality.probes, load.probe_ms, kRaysPerProbe);
  cost.total_ms = load.factor * load.fixed_ms;
  for (const double ms : cost.work_ms) cost.total_ms += ms;
  cost.missed = cost.total_ms > target_ms;
  return cost;
}

struct SimulatedFrame {
  QualityDecision decision;
  double ms = 0;
};

// A display in real time: a frame begins one period after the one before, or later when that took longer.
class SimulatedMachine {
 public:
  explicit SimulatedMachine(const DeadlineConfig& config) : policy(config), config_(config) {}

  SimulatedFrame frame(const Load& load) {
    SimulatedFrame frame;
    frame.decision = policy.decide(config_.limits.full);
    FrameCost cost = cost_of(load, frame.decision.quality, 0, config_.target_ms);
    frame.ms = cost.total_ms;
    now_ns += std::llround(1e6 * std::max(cost.total_ms, config_.target_ms));
    cost.finished_ns = now_ns;
    policy.observe(cost);
    return frame;
  }
  std::vector<SimulatedFrame> frames(int count, const std::function<Load(int)>& load) {
    std::vector<SimulatedFrame> all;
    for (int i = 0; i < count; ++i) all.push_back(frame(load(i)));
    return all;
  }

  DeadlinePolicy policy;
  TimeNs now_ns = 1'000'000'000;

 private:
  DeadlineConfig config_;
};

// Everything wide open, so that a step of 50 can be followed by the width alone.
inline DeadlineConfig wide_config(double target_ms, int narrowest = 1, int full_width = 8192) {
  DeadlineConfig config;
  config.target_ms = target_ms;
  config.limits = quality_limits({1, full_width, 0}, narrowest);
  return config;
}

// One width, so that a step of 50 can be followed by the height alone: from 8192 rows down to 2.
inline DeadlineConfig tall_config(double target_ms) {
  constexpr int kWidth = 16, kRows = 8192;
  DeadlineConfig config;
  config.target_ms = target_ms;
  config.limits = quality_limits({1, kWidth, 0, kRows}, kWidth, 2);
  return config;
}

}  // namespace herr::test
