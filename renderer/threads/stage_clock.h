// Per-task cycle counts of the stages that share one parallel phase, and their conversion to wall time.
// A stage's wall time is the phase's wall time times its share of all thread cycles of the phase; what no
// task spent is `idle`: threads that waited at the end of the phase.
#pragma once

#include <x86intrin.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <span>

#include "renderer/stage_times.h"

namespace herr {

// One worker's counts. Aligned so that two workers never write to the same cache line.
struct alignas(64) StageCycles {
  std::array<std::uint64_t, kStageCount> cycles{};
  std::uint64_t last = 0;

  void start() { last = __rdtsc(); }
  // The cycles since the previous call (or start) belong to `stage`.
  void lap(Stage stage) {
    const std::uint64_t now = __rdtsc();
    cycles[static_cast<std::size_t>(stage)] += now - last;
    last = now;
  }
};

// Measures one parallel phase from construction to finish().
class PhaseClock {
 public:
  explicit PhaseClock(std::span<StageCycles> workers) : workers_(workers) {
    for (StageCycles& worker : workers_) worker.cycles = {};
    wall_start_ = std::chrono::steady_clock::now();
    cycle_start_ = __rdtsc();
  }
  // Adds the phase's wall time to `times`, split by the workers' counts.
  void finish(StageTimes& times) const {
    const std::uint64_t phase_cycles = __rdtsc() - cycle_start_;
    const double wall_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - wall_start_).count();
    const double capacity = static_cast<double>(phase_cycles) * static_cast<double>(workers_.size());
    if (capacity <= 0) return;
    double used_ms = 0;
    for (std::size_t stage = 0; stage < kStageCount; ++stage) {
      std::uint64_t sum = 0;
      for (const StageCycles& worker : workers_) sum += worker.cycles[stage];
      const double ms = wall_ms * static_cast<double>(sum) / capacity;
      times.ms[stage] += ms;
      used_ms += ms;
    }
    if (wall_ms > used_ms) times[Stage::idle] += wall_ms - used_ms;
  }

 private:
  std::span<StageCycles> workers_;
  std::chrono::steady_clock::time_point wall_start_;
  std::uint64_t cycle_start_ = 0;
};

}  // namespace herr
