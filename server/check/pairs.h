// Runs of two builds in turn, and what they came down to. Before: both programs. After: check_against judges
// them, pair by pair.
#pragma once

#include <cstdint>
#include <vector>

#include "server/check/allowed_differences.h"
#include "server/check/measure/measured_program.h"
#include "server/check/measure/run_values.h"

namespace herr {

// Of each program one run a pair.
struct PairValues {
  std::vector<RunValues> candidate, baseline;

  std::vector<RunValues> all() const;  // of both
  // ln(candidate / baseline) of each pair.
  std::vector<double> differences() const;
};

class Pairs {
 public:
  Pairs(MeasuredProgram candidate, MeasuredProgram baseline, std::int64_t frames, AllowedDifferences allowed,
        TimeLimit limit);

  // AB, BA, AB, ...: what changes steadily hits both alike. This program goes first: what is wrong with the
  // input is then its message, not the other's. False where the pair would not end in time or did not: there
  // are then no more than before. Throws as MeasuredProgram::measure otherwise, NotComparable as well where
  // the programs do not do the same.
  bool add_pair();

  int count() const { return static_cast<int>(values.candidate.size()); }
  double typical_seconds() const;  // of a pair; 0 without one

  std::vector<Measurement> candidate_runs, baseline_runs;
  PairValues values;                           // of them
  std::vector<AllowedDifference> differences;  // between the two programs, that were allowed

 private:
  void check_alike(const Measurement& candidate, const Measurement& baseline);

  MeasuredProgram candidate_, baseline_;
  std::int64_t frames_;
  AllowedDifferences allowed_;
  TimeLimit limit_;
  std::vector<double> seconds_;  // that each pair took
};

}  // namespace herr
