#include "server/check/statistics/pair_design.h"

#include <algorithm>
#include <stdexcept>

#include "server/check/statistics/signed_rank.h"

namespace herr {

PairJudgement judge_pairs(std::span<const double> differences, const PairDesign& design) {
  const auto count = static_cast<int>(differences.size());
  if (std::find(design.looks.begin(), design.looks.end(), count) == design.looks.end()) {
    throw std::invalid_argument("the design does not look after so many pairs");
  }
  const auto looks = static_cast<double>(design.looks.size());
  PairJudgement judgement;
  judgement.shift = signed_rank_shift(differences, design.tail / looks);
  judgement.shift.p = std::min(1.0, judgement.shift.p * looks);
  judgement.verdict = verdict_of(judgement.shift, design.rule);
  judgement.last_look = count == design.looks.back();
  return judgement;
}

}  // namespace herr
