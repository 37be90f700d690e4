#include "server/check/check_against.h"

#include <algorithm>
#include <string>
#include <vector>

#include "server/check/check_advice.h"
#include "server/check/check_progress.h"
#include "server/check/pairs.h"
#include "server/check/run_length.h"
#include "server/check/statistics/pair_design.h"
#include "server/check/statistics/signed_rank.h"
#include "server/process/progress_line.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

Shift told_pair_shift(std::span<const double> candidate, std::span<const double> baseline) {
  std::vector<double> differences(candidate.begin(), candidate.end());
  for (std::size_t i = 0; i < differences.size(); ++i) differences[i] -= baseline[i];
  return signed_rank_shift(differences, kToldTail);
}

enum class Look { planned, cut_short };  // where the design has one; where no more pairs come

// Judges all pairs so far; true when no more are needed.
bool look(Look kind, const Pairs& pairs, const PairDesign& design, CheckReport& report) {
  const PairValues& values = pairs.values;
  report.noise = noise_of(values.all());
  report.times = told_times(values.candidate, values.baseline, told_pair_shift);
  report.candidate_ms = median_frame_ms(values.candidate);
  report.baseline_ms = median_frame_ms(values.baseline);

  CheckedTime& median = report.times.front();
  const PairJudgement judgement = kind == Look::planned ? judge_pairs(values.differences(), design)
                                                        : judge_cut_short(values.differences(), design);
  median.shift = judgement.shift;
  median.rule = design.rule;
  median.verdict = judgement.verdict;
  // A look at a restless machine decides nothing but what that cannot excuse; later ones may find it quieter.
  const std::string noise = noise_text(*report.noise);
  const bool beyond_noise = median.verdict == Verdict::regression &&
                            median.shift.lower > design.rule.limit + excused_shift(*report.noise);
  if (!noise.empty() && !beyond_noise) {
    median.verdict = Verdict::noisy;
    median.reason = noise;
    return judgement.last_look;
  }
  if (pairs.count() < fewest_pairs(design)) {
    median.reason = "too few pairs to tell, it takes " + std::to_string(fewest_pairs(design));
  } else if (judgement.verdict == Verdict::inconclusive) {
    median.reason = open_text(median.shift);
  }
  return judgement.verdict != Verdict::inconclusive || judgement.last_look;
}

// How many more pairs it takes at least: as many as allow a verdict, and, where the machine was restless, as
// could outweigh what was measured.
int fewest_more_pairs(const Pairs& pairs, const PairDesign& design) {
  const std::vector<RunValues> runs = pairs.values.all();
  const bool noisy = !noise_text(noise_of(runs)).empty();
  int count = std::max(pairs.count() + 1, fewest_pairs(design));
  while (noisy && count < design.looks.back() && stays_noisy(runs, 2 * count)) ++count;
  return count - pairs.count();
}

// Of a check that could not tell; empty where it could.
std::string advice_of(const CheckOptions& options, const TimeLimit& limit, const Pairs& pairs,
                      const CheckReport& report) {
  const PairDesign design;
  const Verdict verdict = report.times.front().verdict;
  if (verdict != Verdict::noisy && verdict != Verdict::inconclusive) return {};
  const int most = design.looks.back() - pairs.count();
  // Two runs a pair.
  if (verdict == Verdict::noisy && (most == 0 || stays_noisy(pairs.values.all(), 2 * design.looks.back()))) {
    return noisy_advice(*report.noise, "pairs");
  }
  if (most == 0) return longer_runs_advice(options.run.replay.frames, options.run_seconds);
  return more_runs_advice({"pair", "pairs", fewest_more_pairs(pairs, design), most,
                           options.max_seconds.value_or(0) - limit.seconds_left(), pairs.typical_seconds()});
}

// Pairs and looks until the verdict is clear, time runs out, or nothing but `noisy` can come.
void run_pairs(const TimeLimit& limit, Pairs& pairs, CheckReport& report) {
  const PairDesign design;
  const int most = design.looks.back();
  ProgressLine progress;
  while (pairs.add_pair()) {
    const bool at_look =
        std::find(design.looks.begin(), design.looks.end(), pairs.count()) != design.looks.end();
    if (at_look && look(Look::planned, pairs, design, report)) return;
    // Two runs a pair.
    if (stays_noisy(pairs.values.all(), 2 * most)) {
      report.ended_early = "ended after " + pairs_text(pairs.count(), design) +
                           ": whatever the others measured, the machine is too restless";
      break;
    }
    const Shift shift = signed_rank_shift(pairs.values.differences(), kToldTail);
    progress.show(pair_progress(pairs.count(), design, state_so_far(noise_of(pairs.values.all()), shift),
                                pairs.typical_seconds(), limit.seconds_left()),
                  at_look);
  }
  if (pairs.count() == 0) throw OutOfTime();
  if (report.ended_early.empty()) {
    report.ended_early = "--max-seconds ended it after " + pairs_text(pairs.count(), design);
  }
  look(Look::cut_short, pairs, design, report);
}

}  // namespace

void check_against(const CheckOptions& options, const TimeLimit& limit, CheckReport& report) {
  const MeasuredProgram candidate = candidate_of(options);
  const MeasuredProgram baseline = MeasuredProgram::other(options.against, options.run_arguments);
  const std::int64_t frames = frames_of_run(options, candidate, limit);
  Pairs pairs(candidate, baseline, frames, options.allowed, limit);
  if (options.tiers != CheckedTiers::counters) {
    run_pairs(limit, pairs, report);
    report.advice = advice_of(options, limit, pairs, report);
  } else if (!pairs.add_pair()) {
    throw OutOfTime();
  }
  const Measurement& first = pairs.candidate_runs.front();
  report.candidate = "this program (" + printable(first.program) + ")";
  report.baseline =
      printable(options.against.string()) + " (" + printable(pairs.baseline_runs.front().program) + ")";
  report.settings = settings_line(first.fingerprint);
  report.runs = report.baseline_runs = pairs.count();
  report.frames = static_cast<std::int64_t>(first.frame_ms.size());
  report.differences = pairs.differences;
  if (options.tiers != CheckedTiers::times) {
    std::vector<CounterRange> before = counter_ranges(pairs.baseline_runs);
    std::vector<CounterRange> now = counter_ranges(pairs.candidate_runs);
    complete_ray_kinds(before, now);
    report.counters = judge_counters(before, now);
  }
  conclude(report);
}

}  // namespace herr
