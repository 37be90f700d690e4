#include "server/check/pairs.h"

#include <string>
#include <utility>

#include "renderer/timing.h"
#include "server/check/measure/not_comparable.h"

namespace herr {
namespace {

std::string any_difference(const CheckFingerprint& earlier, const CheckFingerprint& now) {
  const std::string work = work_difference(earlier, now);
  return work.empty() ? machine_difference(earlier, now) : work;
}

}  // namespace

std::vector<RunValues> PairValues::all() const {
  std::vector<RunValues> runs = candidate;
  runs.insert(runs.end(), baseline.begin(), baseline.end());
  return runs;
}

std::vector<double> PairValues::differences() const {
  std::vector<double> logs = logarithms(candidate, &RunValues::median);
  const std::vector<double> before = logarithms(baseline, &RunValues::median);
  for (std::size_t i = 0; i < logs.size(); ++i) logs[i] -= before[i];
  return logs;
}

Pairs::Pairs(MeasuredProgram candidate, MeasuredProgram baseline, std::int64_t frames,
             AllowedDifferences allowed, TimeLimit limit)
    : candidate_(std::move(candidate)),
      baseline_(std::move(baseline)),
      frames_(frames),
      allowed_(std::move(allowed)),
      limit_(limit) {}

bool Pairs::add_pair() {
  if (!limit_.has_room_for_another(seconds_)) return false;
  Measurement candidate, baseline;
  try {
    const double ms = wall_ms([&] {
      if (count() % 2 == 0) {
        candidate = candidate_.measure(frames_, limit_);
        baseline = baseline_.measure(frames_, limit_);
      } else {
        baseline = baseline_.measure(frames_, limit_);
        candidate = candidate_.measure(frames_, limit_);
      }
    });
    seconds_.push_back(1e-3 * ms);
  } catch (const OutOfTime&) {
    return false;
  }
  check_alike(candidate, baseline);
  values.candidate.push_back(run_values(candidate));
  values.baseline.push_back(run_values(baseline));
  candidate_runs.push_back(std::move(candidate));
  baseline_runs.push_back(std::move(baseline));
  return true;
}

double Pairs::typical_seconds() const {
  return median(seconds_);
}

// The first pair says what differs between the programs; nothing may change after it.
void Pairs::check_alike(const Measurement& candidate, const Measurement& baseline) {
  if (count() == 0) {
    const std::string what = "the programs do not do the same";
    const std::string machine = machine_difference(baseline.fingerprint, candidate.fingerprint);
    if (!machine.empty()) throw NotComparable(what + ": " + machine);
    differences =
        told_differences(work_differences(baseline.fingerprint, candidate.fingerprint), allowed_, what);
    return;
  }
  for (const auto& [first, last] :
       {std::pair{&candidate_runs.front(), &candidate}, std::pair{&baseline_runs.front(), &baseline}}) {
    const std::string changed = any_difference(first->fingerprint, last->fingerprint);
    if (!changed.empty()) throw NotComparable("the inputs changed while they were measured: " + changed);
  }
}

}  // namespace herr
