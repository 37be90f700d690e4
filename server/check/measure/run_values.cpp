#include "server/check/measure/run_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "renderer/timing.h"
#include "server/check/statistics/lasting_noise.h"

namespace herr {
namespace {

constexpr double kTail = 0.05;

// Of sorted values: the smallest with at least the share `p` at or below it.
double quantile(const std::vector<double>& sorted, double p) {
  const auto rank = static_cast<std::size_t>(std::ceil(p * static_cast<double>(sorted.size())));
  return sorted[std::clamp<std::size_t>(rank, 1, sorted.size()) - 1];
}

// The counter of one run; not a number where it is unknown.
double value_in(const Measurement& run, const std::string& name) {
  const auto found = std::find_if(run.counters.begin(), run.counters.end(),
                                  [&](const auto& counter) { return counter.first == name; });
  if (found == run.counters.end()) return 0;
  return found->second.value_or(std::numeric_limits<double>::quiet_NaN());
}

void add_missing_kinds(const std::vector<CounterRange>& from, std::vector<CounterRange>& to) {
  for (const CounterRange& range : from) {
    const bool known = std::any_of(to.begin(), to.end(),
                                   [&](const CounterRange& other) { return other.name == range.name; });
    if (!known && range.name.starts_with("rays.")) to.push_back({range.name, 0, 0});
  }
}

}  // namespace

RunValues run_values(const Measurement& measurement) {
  const std::size_t frames = measurement.frame_ms.size();
  std::vector<double> calibrated(frames);
  for (std::size_t i = 0; i < frames; ++i) {
    const auto unit_ms = [&](std::size_t k) {
      return measurement.calibration_rays_ms[k] + measurement.calibration_memory_ms[k];
    };
    calibrated[i] = measurement.frame_ms[i] / std::min(unit_ms(i), unit_ms(i + 1));
  }
  RunValues values;
  values.median = median(calibrated);
  values.frame_ms = median(measurement.frame_ms);
  values.rays_ms = median(measurement.calibration_rays_ms);
  values.cpu = measurement.cpu;
  std::sort(calibrated.begin(), calibrated.end());
  values.p95 = quantile(calibrated, 1 - kTail);
  const auto worst = static_cast<std::size_t>(std::ceil(kTail * static_cast<double>(frames)));
  for (std::size_t i = frames - worst; i < frames; ++i) values.worst_twentieth += calibrated[i];
  values.worst_twentieth /= static_cast<double>(worst);
  return values;
}

std::vector<double> logarithms(std::span<const RunValues> runs, double RunValues::*value) {
  std::vector<double> logarithms;
  for (const RunValues& run : runs) logarithms.push_back(std::log(run.*value));
  return logarithms;
}

double median_frame_ms(std::span<const RunValues> runs) {
  std::vector<double> values;
  for (const RunValues& run : runs) values.push_back(run.frame_ms);
  return median(std::move(values));
}

Noise noise_of(std::span<const RunValues> runs) {
  std::vector<double> rays_ms;
  CpuTicks ticks;
  bool known = true;
  for (const RunValues& run : runs) {
    rays_ms.push_back(run.rays_ms);
    known = known && run.cpu.has_value();
    if (run.cpu) ticks.used += run.cpu->used, ticks.stolen += run.cpu->stolen;
  }
  Noise noise;
  noise.calibration_cv = robust_cv(rays_ms);
  noise.steal = std::numeric_limits<double>::quiet_NaN();
  const auto asked = static_cast<double>(ticks.used + ticks.stolen);
  if (known) noise.steal = asked > 0 ? static_cast<double>(ticks.stolen) / asked : 0.0;
  return noise;
}

bool stays_noisy(std::span<const RunValues> runs, int final_count) {
  std::vector<double> rays_ms;
  std::vector<CpuDemand> demands;
  for (const RunValues& run : runs) {
    rays_ms.push_back(run.rays_ms);
    CpuDemand demand{0, std::numeric_limits<double>::quiet_NaN()};
    if (run.cpu) {
      demand.asked = static_cast<double>(run.cpu->used + run.cpu->stolen);
      demand.stolen = static_cast<double>(run.cpu->stolen);
    }
    demands.push_back(demand);
  }
  return speed_stays_restless(rays_ms, final_count) || steal_stays_high(demands, final_count);
}

std::vector<CounterRange> counter_ranges(std::span<const Measurement> runs) {
  std::vector<CounterRange> ranges;
  std::set<std::string> seen;
  for (const Measurement& run : runs) {
    for (const auto& [name, unused_here] : run.counters) {
      if (!seen.insert(name).second) continue;
      CounterRange range{name, std::numeric_limits<double>::infinity(), 0};
      bool known = true;
      for (const Measurement& other : runs) {
        const double value = value_in(other, name);
        known = known && std::isfinite(value);
        range.lowest = std::min(range.lowest, value), range.highest = std::max(range.highest, value);
      }
      if (known) ranges.push_back(range);
    }
  }
  return ranges;
}

void complete_ray_kinds(std::vector<CounterRange>& a, std::vector<CounterRange>& b) {
  add_missing_kinds(a, b);
  add_missing_kinds(b, a);
}

}  // namespace herr
