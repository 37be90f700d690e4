#include "server/check/check_against.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "server/check/measure/not_comparable.h"
#include "server/check/run_length.h"
#include "server/check/statistics/pair_design.h"
#include "server/check/statistics/signed_rank.h"
#include "server/process/progress_bar.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

// Both programs, run in turn, and what their runs came down to.
class Pairs {
 public:
  Pairs(MeasuredProgram candidate, MeasuredProgram baseline, std::int64_t frames)
      : candidate_(std::move(candidate)), baseline_(std::move(baseline)), frames_(frames) {}

  // AB, BA, AB, ...: what changes steadily hits both alike. This program goes first: what is wrong with the
  // input is then its message, not the other's.
  void add_pair() {
    if (candidate_runs.size() % 2 == 0) {
      add(candidate_, candidate_runs);
      add(baseline_, baseline_runs);
    } else {
      add(baseline_, baseline_runs);
      add(candidate_, candidate_runs);
    }
    check_alike(baseline_runs.front(), candidate_runs.back());
    check_alike(baseline_runs.front(), baseline_runs.back());
  }

  std::vector<RunValues> values_of(const std::vector<Measurement>& runs) const {
    std::vector<RunValues> values;
    for (const Measurement& run : runs) values.push_back(run_values(run));
    return values;
  }

  std::vector<Measurement> candidate_runs, baseline_runs;

 private:
  void add(const MeasuredProgram& program, std::vector<Measurement>& runs) {
    runs.push_back(program.measure(frames_));
  }
  static void check_alike(const Measurement& baseline, const Measurement& candidate) {
    std::string what = work_difference(baseline.fingerprint, candidate.fingerprint);
    if (what.empty()) what = machine_difference(baseline.fingerprint, candidate.fingerprint);
    if (!what.empty()) throw NotComparable("the programs do not do the same: " + what);
  }

  MeasuredProgram candidate_, baseline_;
  std::int64_t frames_;
};

std::vector<double> differences(std::span<const double> candidate, std::span<const double> baseline) {
  std::vector<double> values;
  for (std::size_t i = 0; i < candidate.size(); ++i) values.push_back(candidate[i] - baseline[i]);
  return values;
}

Shift told_pair_shift(std::span<const double> candidate, std::span<const double> baseline) {
  return signed_rank_shift(differences(candidate, baseline), kToldTail);
}

// Judges all pairs so far; true when no more are needed.
bool look(const Pairs& pairs, const PairDesign& design, CheckReport& report) {
  const std::vector<RunValues> candidate = pairs.values_of(pairs.candidate_runs);
  const std::vector<RunValues> baseline = pairs.values_of(pairs.baseline_runs);
  std::vector<RunValues> all = candidate;
  all.insert(all.end(), baseline.begin(), baseline.end());
  report.noise = noise_of(all);
  report.times = told_times(candidate, baseline, told_pair_shift);
  report.candidate_ms = median_frame_ms(candidate), report.baseline_ms = median_frame_ms(baseline);

  CheckedTime& median = report.times.front();
  const PairJudgement judgement = judge_pairs(
      differences(logarithms(candidate, &RunValues::median), logarithms(baseline, &RunValues::median)),
      design);
  median.shift = judgement.shift;
  median.rule = design.rule;
  median.verdict = judgement.verdict;
  // A look at a restless machine decides nothing; later ones may find it quieter.
  if (const std::string noise = noise_text(*report.noise); !noise.empty()) {
    median.verdict = Verdict::noisy;
    median.reason = noise;
    return judgement.last_look;
  }
  if (judgement.verdict == Verdict::inconclusive) {
    median.reason = open_text(median.shift);
  }
  return judgement.verdict != Verdict::inconclusive || judgement.last_look;
}

}  // namespace

void check_against(const CheckOptions& options, CheckReport& report) {
  const MeasuredProgram candidate = candidate_of(options);
  const MeasuredProgram baseline = MeasuredProgram::other(options.against, options.run_arguments);
  const std::int64_t frames = frames_of_run(options, candidate);
  Pairs pairs(candidate, baseline, frames);
  const PairDesign design;
  const bool timed = options.tiers != CheckedTiers::counters;
  ProgressBar progress("pairs of runs", timed ? design.looks.back() : 1);
  for (bool done = false; !done;) {
    pairs.add_pair();
    const auto count = static_cast<int>(pairs.candidate_runs.size());
    progress.update(count);
    const bool at_look = std::find(design.looks.begin(), design.looks.end(), count) != design.looks.end();
    done = !timed || (at_look && look(pairs, design, report));
  }
  const Measurement& first = pairs.candidate_runs.front();
  report.candidate = "this program (" + printable(first.program) + ")";
  report.baseline =
      printable(options.against.string()) + " (" + printable(pairs.baseline_runs.front().program) + ")";
  report.settings = settings_line(first.fingerprint);
  report.runs = report.baseline_runs = static_cast<int>(pairs.candidate_runs.size());
  report.frames = static_cast<std::int64_t>(first.frame_ms.size());
  if (options.tiers != CheckedTiers::times) {
    std::vector<CounterRange> before = counter_ranges(pairs.baseline_runs);
    std::vector<CounterRange> now = counter_ranges(pairs.candidate_runs);
    complete_ray_kinds(before, now);
    report.counters = judge_counters(before, now);
  }
  conclude(report);
}

}  // namespace herr
