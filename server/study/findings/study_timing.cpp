#include "server/study/findings/study_timing.h"

#include <cmath>
#include <vector>

#include "renderer/timing.h"
#include "server/check/statistics/noise.h"
#include "server/statistics/miss_cause.h"
#include "server/text/number_text.h"

namespace herr {

bool is_the_default(const StudyRow& row) {
  return row.flags.empty();
}

StudyTiming timing_of(std::span<const StudyRow> rows) {
  StudyTiming timing;
  std::vector<double> deviations;
  double cpu_ms = 0, cores_ms = 0;
  bool known = true;
  for (const StudyRow& row : rows) {
    if (row.log_ratios.empty()) continue;  // of a clip
    timing.pairs += static_cast<int>(row.log_ratios.size());
    timing.preemptions += row.preemptions;
    cpu_ms += row.cpu_ms, cores_ms += row.cores_ms;
    known = known && row.cpu_ms > 0;
    if (row.log_ratios.size() < 2) continue;
    const double truth = is_the_default(row) ? 0 : median(row.log_ratios);
    for (const double ratio : row.log_ratios) deviations.push_back(std::abs(ratio - truth));
  }
  if (!deviations.empty()) timing.spread = std::expm1(kSigmaPerDeviation * median(deviations));
  if (known && cores_ms > 0) timing.cpu_share = cpu_ms / cores_ms;
  timing.sentence = timing_text(timing);
  return timing;
}

std::string timing_text(const StudyTiming& timing) {
  const bool waited = timing.preemptions > 0 && timing.cpu_share.value_or(1) < kBusyShare;
  const auto percent = [](double share, int decimals) { return fixed_text(100 * share, decimals) + " %"; };
  if (timing.spread <= kMostCalibrationCv && !waited)
    return "repeats of one setting differ by " + percent(timing.spread, 1);
  return "the machine was busy, and ratios are uncertain by " + percent(timing.spread, 1) +
         ", as repeats of one setting differ (threads had " +
         (timing.cpu_share ? percent(*timing.cpu_share, 0) : "n/a") + " of their cores, " +
         fixed_text(timing.preemptions, 0) +
         " preemptions): take smaller differences of time for none, or study again when the machine is quiet";
}

}  // namespace herr
