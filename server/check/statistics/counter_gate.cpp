#include "server/check/statistics/counter_gate.h"

#include <algorithm>

namespace herr {
namespace {

// Counts below 2^53 divided by frames and multiplied by the limit: each step is off by 2^-53 of itself.
constexpr double kRoundingSlack = 1e-12;

const CounterRange* find(const std::vector<CounterRange>& ranges, const std::string& name) {
  const auto found = std::find_if(ranges.begin(), ranges.end(),
                                  [&](const CounterRange& range) { return range.name == name; });
  return found == ranges.end() ? nullptr : &*found;
}

CounterJudgement judge(const CounterRange& baseline, const CounterRange& candidate) {
  CounterJudgement judgement{baseline.name, Verdict::inconclusive, baseline.highest, candidate.highest, {}};
  const double allowed = (1 + kCounterLimit) * (1 + kRoundingSlack);
  // Both comparisons are false for what is not a number.
  if (candidate.lowest > allowed * baseline.highest) {
    judgement.verdict = Verdict::regression;
  } else if (candidate.highest <= allowed * baseline.lowest) {
    judgement.verdict = Verdict::ok;
  } else {
    judgement.reason = "differs from run to run of one program";
  }
  return judgement;
}

CounterJudgement missing(const CounterRange& only, bool in_baseline) {
  CounterJudgement judgement{only.name, Verdict::inconclusive, 0, 0, {}};
  (in_baseline ? judgement.baseline : judgement.candidate) = only.highest;
  if (!in_baseline && only.highest == 0) {
    judgement.verdict = Verdict::ok;  // no more than whatever it was
    return judgement;
  }
  judgement.reason = in_baseline ? "the candidate does not count it" : "the baseline does not count it";
  return judgement;
}

}  // namespace

std::vector<CounterJudgement> judge_counters(const std::vector<CounterRange>& baseline,
                                             const std::vector<CounterRange>& candidate) {
  std::vector<CounterJudgement> judgements;
  for (const CounterRange& before : baseline) {
    const CounterRange* now = find(candidate, before.name);
    judgements.push_back(now != nullptr ? judge(before, *now) : missing(before, true));
  }
  for (const CounterRange& now : candidate) {
    if (find(baseline, now.name) == nullptr) judgements.push_back(missing(now, false));
  }
  return judgements;
}

}  // namespace herr
