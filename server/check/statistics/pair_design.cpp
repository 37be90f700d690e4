#include "server/check/statistics/pair_design.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "server/check/statistics/signed_rank.h"

namespace herr {
namespace {

PairJudgement judge_with_one_share(std::span<const double> differences, const PairDesign& design) {
  const auto looks = static_cast<double>(design.looks.size());
  PairJudgement judgement;
  judgement.shift = signed_rank_shift(differences, design.tail / looks);
  judgement.shift.p = std::min(1.0, judgement.shift.p * looks);
  judgement.verdict = verdict_of(judgement.shift, design.rule);
  return judgement;
}

}  // namespace

PairJudgement judge_pairs(std::span<const double> differences, const PairDesign& design) {
  const auto count = static_cast<int>(differences.size());
  if (std::find(design.looks.begin(), design.looks.end(), count) == design.looks.end()) {
    throw std::invalid_argument("the design does not look after so many pairs");
  }
  PairJudgement judgement = judge_with_one_share(differences, design);
  judgement.last_look = count == design.looks.back();
  return judgement;
}

PairJudgement judge_cut_short(std::span<const double> differences, const PairDesign& design) {
  const auto count = static_cast<int>(differences.size());
  if (count > design.looks.back()) throw std::invalid_argument("more pairs than the design has");
  PairJudgement judgement = judge_with_one_share(differences, design);
  if (count < fewest_pairs(design)) judgement.verdict = Verdict::inconclusive;
  judgement.last_look = true;
  return judgement;
}

int fewest_pairs(const PairDesign& design) {
  const auto looks = static_cast<double>(design.looks.size());
  return static_cast<int>(std::ceil(std::log2(looks / design.rule.significance)));
}

}  // namespace herr
