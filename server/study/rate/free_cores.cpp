#include "server/study/rate/free_cores.h"

#include <algorithm>
#include <vector>

#include "server/text/number_text.h"

namespace herr {
namespace {

// The lower of the two in the middle of an even number, as of what was measured.
std::optional<double> median_free_ms(const std::vector<RateTrial>& trials) {
  std::vector<double> sorted;
  for (const RateTrial& trial : trials) {
    if (!trial.free_p95_ms) return std::nullopt;
    sorted.push_back(*trial.free_p95_ms);
  }
  std::sort(sorted.begin(), sorted.end());
  return sorted[(sorted.size() - 1) / 2];
}

std::string text_of(const FreeRate& rate) {
  return text_of(rate.setting) + " (about " + fixed_text(rate.p95_ms, 2) + " ms)";
}

}  // namespace

std::optional<FreeCores> free_cores_of(const RateAnswer& answer) {
  if (answer.tried.empty() || !answer.machine().busy()) return std::nullopt;
  FreeCores free;
  for (const MeasuredRate& each : answer.tried) {
    const std::optional<double> p95_ms = median_free_ms(each.trials);
    if (!p95_ms) return std::nullopt;
    if (free.refused) continue;
    const FreeRate rate{each.setting, *p95_ms};
    (*p95_ms <= answer.period_ms ? free.holds : free.refused) = rate;
  }
  return free;
}

std::string free_cores_text(const FreeCores& free) {
  if (!free.holds) return "not even the smallest that was measured holds, " + text_of(*free.refused);
  if (!free.refused) return "even the largest that was measured holds, " + text_of(*free.holds);
  return "a setting that holds is " + text_of(*free.holds) + ", the next measured, which does not, " +
         text_of(*free.refused);
}

}  // namespace herr
