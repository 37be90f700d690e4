#include "server/check/check_baseline.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "server/check/baseline_file.h"
#include "server/check/measure/not_comparable.h"
#include "server/check/run_length.h"
#include "server/check/statistics/baseline_design.h"
#include "server/check/statistics/rank_sum.h"
#include "server/process/exit_code.h"
#include "server/process/progress_bar.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

Shift told_rank_shift(std::span<const double> candidate, std::span<const double> baseline) {
  return rank_sum_shift(candidate, baseline, kToldTail);
}

// Runs of this program after the first one, all of the same work.
struct Runs {
  std::vector<Measurement> measured;
  std::vector<RunValues> values;

  void add(const MeasuredProgram& program, std::int64_t frames) {
    measured.push_back(program.measure(frames));
    values.push_back(run_values(measured.back()));
    const std::string what = work_difference(measured.front().fingerprint, measured.back().fingerprint);
    if (!what.empty()) throw NotComparable("the inputs changed while they were measured: " + what);
  }
  void add_until(int count, const MeasuredProgram& program, std::int64_t frames) {
    ProgressBar progress("runs", count);
    while (static_cast<int>(measured.size()) < count) {
      add(program, frames);
      progress.update(static_cast<std::int64_t>(measured.size()));
    }
  }
};

void describe(const Runs& runs, CheckReport& report) {
  const Measurement& first = runs.measured.front();
  report.candidate = "this program (" + printable(first.program) + ")";
  report.settings = settings_line(first.fingerprint);
  report.runs = static_cast<int>(runs.measured.size());
  report.frames = static_cast<std::int64_t>(first.frame_ms.size());
  report.candidate_ms = median_frame_ms(runs.values);
}

void judge_times(const Baseline& baseline, const Runs& runs, CheckReport& report) {
  const BaselineDesign design;
  report.noise = noise_of(runs.values);
  report.times = told_times(runs.values, baseline.runs, told_rank_shift);
  report.baseline_ms = median_frame_ms(baseline.runs);
  CheckedTime& median = report.times.front();
  const BaselineJudgement judgement = judge_against_baseline(
      logarithms(runs.values, &RunValues::median), logarithms(baseline.runs, &RunValues::median), design);
  median.shift = judgement.shift;
  median.rule = design.rule;
  median.verdict = judgement.verdict;
  if (const std::string noise = noise_text(*report.noise); !noise.empty()) {
    median.verdict = Verdict::noisy;
    median.reason = noise;
  } else if (baseline.runs.size() < static_cast<std::size_t>(design.stored_runs)) {
    median.reason = "the baseline holds " +
                    counted(static_cast<std::int64_t>(baseline.runs.size()), "run", "runs") + ", not " +
                    std::to_string(design.stored_runs);
  } else if (judgement.verdict == Verdict::inconclusive) {
    median.reason = open_text(median.shift);
  }
}

}  // namespace

void save_baseline(const CheckOptions& options, CheckReport& report) {
  report.baseline = printable(options.save.string());
  if (!options.overwrite && path_exists(options.save)) {
    throw UsageError("--save: " + printable(options.save.string()) +
                     " is there already; give --overwrite to replace it");
  }
  const MeasuredProgram program = candidate_of(options);
  const std::int64_t frames = frames_of_run(options, program);
  const bool timed = options.tiers != CheckedTiers::counters;
  Runs runs;
  runs.add_until(timed ? BaselineDesign{}.stored_runs : 1, program, frames);
  describe(runs, report);
  report.noise = noise_of(runs.values);
  if (const std::string noise = noise_text(*report.noise); timed && !noise.empty()) {
    report.verdict = Verdict::noisy;
    report.reason = noise + "; nothing was stored";
    return;
  }
  const Measurement& first = runs.measured.front();
  write_whole_file(options.save, baseline_text({first.program, frames, first.fingerprint, runs.values,
                                                counter_ranges(runs.measured)}));
  report.verdict = Verdict::ok;
  report.reason = counted(static_cast<std::int64_t>(runs.measured.size()), "run", "runs") + " stored in " +
                  printable(options.save.string());
}

void check_baseline(const CheckOptions& options, CheckReport& report) {
  const Baseline baseline = read_baseline(options.baseline);
  report.baseline = printable(options.baseline.string()) + " (" + printable(baseline.program) + ")";
  report.baseline_runs = static_cast<int>(baseline.runs.size());
  const MeasuredProgram program = candidate_of(options);
  // The same frames as then, whatever they take here; another choice would be other work.
  const std::int64_t frames = options.run.replay.frames.value_or(baseline.frames);
  Runs runs;
  runs.add(program, frames);
  const CheckFingerprint& now = runs.measured.front().fingerprint;
  // The stored runs were given other flags than these: a setting that they do not know had its default.
  if (const std::string what = difference(baseline.fingerprint.work, now.work); !what.empty()) {
    throw NotComparable("the baseline did other work: " + what);
  }
  const std::string other_machine = machine_difference(baseline.fingerprint, now);
  const bool timed = options.tiers != CheckedTiers::counters;
  if (timed && other_machine.empty()) {
    runs.add_until(BaselineDesign{}.runs, program, frames);
    judge_times(baseline, runs, report);
  } else if (timed) {
    CheckedTime unknown;
    unknown.name = unknown.title = "median";
    unknown.decides = true;
    unknown.verdict = Verdict::not_comparable;
    unknown.reason = "the baseline is of another machine: " + other_machine;
    unknown.rule = BaselineDesign{}.rule;
    report.times = {unknown};
  }
  describe(runs, report);
  if (options.tiers != CheckedTiers::times) {
    std::vector<CounterRange> before = baseline.counters, counted = counter_ranges(runs.measured);
    complete_ray_kinds(before, counted);
    report.counters = judge_counters(before, counted);
  }
  conclude(report);
}

}  // namespace herr
