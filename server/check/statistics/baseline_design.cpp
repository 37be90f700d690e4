#include "server/check/statistics/baseline_design.h"

#include <cstddef>

#include "server/check/statistics/rank_sum.h"

namespace herr {

BaselineJudgement judge_against_baseline(std::span<const double> now, std::span<const double> stored,
                                         const BaselineDesign& design) {
  BaselineJudgement judgement;
  if (now.empty() || stored.empty()) return judgement;
  judgement.shift = rank_sum_shift(now, stored, design.tail);
  const bool enough = now.size() >= static_cast<std::size_t>(design.runs) &&
                      stored.size() >= static_cast<std::size_t>(design.stored_runs);
  if (enough) judgement.verdict = verdict_of(judgement.shift, design.rule);
  return judgement;
}

}  // namespace herr
