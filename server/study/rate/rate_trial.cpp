#include "server/study/rate/rate_trial.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "server/check/statistics/noise.h"
#include "server/statistics/miss_cause.h"
#include "server/text/number_text.h"

namespace herr {

void MachineUse::add(const MachineUse& other) {
  cpu_ms += other.cpu_ms, cores_ms += other.cores_ms;
  cpu_known = cpu_known && other.cpu_known;
  preemptions += other.preemptions;
  late += other.late, late_by_machine += other.late_by_machine;
  used_ticks += other.used_ticks, stolen_ticks += other.stolen_ticks;
}

std::optional<double> MachineUse::cpu_share() const {
  if (!cpu_known || !(cores_ms > 0)) return std::nullopt;
  return cpu_ms / cores_ms;
}

double MachineUse::steal() const {
  const std::int64_t asked = used_ticks + stolen_ticks;
  return asked > 0 ? static_cast<double>(stolen_ticks) / static_cast<double>(asked) : 0.0;
}

bool MachineUse::busy() const {
  const bool waited = preemptions > 0 && cpu_share().value_or(1) < kBusyShare;
  return waited || 2 * late_by_machine > late || steal() > kMostSteal;
}

std::string MachineUse::text() const {
  const std::optional<double> share = cpu_share();
  const auto percent = [](double of_one) { return fixed_text(100 * of_one, 0) + " %"; };
  return std::to_string(late_by_machine) + " of " + std::to_string(late) +
         " late frames for the machine alone, " + std::to_string(preemptions) + " preemptions, threads had " +
         (share ? percent(*share) : "n/a") + " of their cores, a hypervisor took " + percent(steal());
}

const RateStretch* worst_stretch(const RateTrial& trial) {
  const RateStretch* worst = nullptr;
  for (const RateStretch& each : trial.stretches) {
    if (each.frames < kFewestOfStretch) continue;
    if (worst == nullptr || each.p95_ms > worst->p95_ms) worst = &each;
  }
  return worst;
}

double free_frame_ms(double frame_ms, double render_ms, double cpu_ms, int cores) {
  return frame_ms - std::max(0.0, render_ms - cpu_ms / cores);
}

double percentile_95(std::span<const double> times_ms) {
  std::vector<double> sorted(times_ms.begin(), times_ms.end());
  std::sort(sorted.begin(), sorted.end());
  const auto rank = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace herr
