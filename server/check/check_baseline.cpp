#include "server/check/check_baseline.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "renderer/timing.h"
#include "server/check/allowed_differences.h"
#include "server/check/baseline_file.h"
#include "server/check/check_advice.h"
#include "server/check/check_progress.h"
#include "server/check/measure/not_comparable.h"
#include "server/check/run_length.h"
#include "server/check/statistics/baseline_design.h"
#include "server/check/statistics/rank_sum.h"
#include "server/process/exit_code.h"
#include "server/process/progress_line.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

Shift told_rank_shift(std::span<const double> candidate, std::span<const double> baseline) {
  return rank_sum_shift(candidate, baseline, kToldTail);
}

// Runs of this program one after the other, all of the same work.
class Runs {
 public:
  Runs(MeasuredProgram program, std::int64_t frames, TimeLimit limit)
      : program_(std::move(program)), frames_(frames), limit_(limit) {}

  // Throws OutOfTime.
  void add() {
    const double ms = wall_ms([&] { measured.push_back(program_.measure(frames_, limit_)); });
    seconds_.push_back(1e-3 * ms);
    values.push_back(run_values(measured.back()));
    const std::string what = work_difference(measured.front().fingerprint, measured.back().fingerprint);
    if (!what.empty()) throw NotComparable("the inputs changed while they were measured: " + what);
  }

  // Until there are `count`; why there are fewer, empty where there are not. `stored`: the runs to compare
  // with, if any.
  std::string add_until(int count, std::span<const RunValues> stored) {
    ProgressLine progress;
    while (this->count() < count) {
      if (!add_in_time()) return "--max-seconds ended it after " + of_runs(count);
      if (this->count() == count) break;
      if (stays_noisy(values, count)) {
        return "ended after " + of_runs(count) +
               ": whatever the others measured, the machine is too restless";
      }
      progress.show(
          run_progress(this->count(), count, state(stored), median(seconds_), limit_.seconds_left()));
    }
    return {};
  }

  std::int64_t frames() const { return frames_; }  // that each was asked for

  // Where there are fewer than `of`, or the machine was too restless for as many.
  std::string advice(const CheckOptions& options, int of) const {
    const Noise noise = noise_of(values);
    const bool noisy = !noise_text(noise).empty();
    if (noisy && (count() >= of || stays_noisy(values, of))) return noisy_advice(noise, "runs");
    if (count() >= of) return {};
    const int more = of - count();
    return more_runs_advice({"run", "runs", more, more,
                             options.max_seconds.value_or(0) - limit_.seconds_left(), median(seconds_)});
  }

  std::vector<Measurement> measured;
  std::vector<RunValues> values;

 private:
  int count() const { return static_cast<int>(measured.size()); }
  std::string of_runs(int count) const {
    return std::to_string(this->count()) + " of " + std::to_string(count) + " runs";
  }
  bool add_in_time() {
    if (!limit_.has_room_for_another(seconds_)) return false;
    try {
      add();
    } catch (const OutOfTime&) {
      if (measured.empty()) throw;
      return false;
    }
    return true;
  }
  std::string state(std::span<const RunValues> stored) const {
    const Noise noise = noise_of(values);
    if (!stored.empty()) {
      return state_so_far(noise, told_rank_shift(logarithms(values, &RunValues::median),
                                                 logarithms(stored, &RunValues::median)));
    }
    return noise_text(noise).empty() ? "quiet so far" : "noisy so far";
  }

  MeasuredProgram program_;
  std::int64_t frames_;
  TimeLimit limit_;
  std::vector<double> seconds_;  // that each run took
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
  const auto count = static_cast<int>(runs.values.size());
  if (const std::string noise = noise_text(*report.noise); !noise.empty()) {
    median.verdict = Verdict::noisy;
    median.reason = noise;
  } else if (count < design.runs) {
    median.reason = "too few runs to tell, it takes " + std::to_string(design.runs);
  } else if (baseline.runs.size() < static_cast<std::size_t>(design.stored_runs)) {
    median.reason = "the baseline holds " +
                    counted(static_cast<std::int64_t>(baseline.runs.size()), "run", "runs") + ", not " +
                    std::to_string(design.stored_runs);
  } else if (judgement.verdict == Verdict::inconclusive) {
    median.reason = open_text(median.shift);
  }
}

// Of a check that could not tell; empty where it could.
std::string advice_of(const CheckOptions& options, const Baseline& baseline, const Runs& runs,
                      const CheckReport& report) {
  const BaselineDesign design;
  const Verdict verdict = report.times.front().verdict;
  if (verdict != Verdict::noisy && verdict != Verdict::inconclusive) return {};
  if (std::string advice = runs.advice(options, design.runs); !advice.empty()) return advice;
  const std::string again = "store " + std::to_string(design.stored_runs) + " again with --save";
  if (baseline.runs.size() < static_cast<std::size_t>(design.stored_runs)) return again;
  const std::int64_t frames = 2 * runs.frames();
  return "pairs tell more than stored runs: --against PROGRAM; or " + again + " --frames " +
         std::to_string(frames);
}

}  // namespace

void save_baseline(const CheckOptions& options, const TimeLimit& limit, CheckReport& report) {
  report.baseline = printable(options.save.string());
  if (!options.overwrite && path_exists(options.save)) {
    throw UsageError("--save: " + printable(options.save.string()) +
                     " is there already; give --overwrite to replace it");
  }
  const MeasuredProgram program = candidate_of(options);
  Runs runs(program, frames_of_run(options, program, limit), limit);
  const bool timed = options.tiers != CheckedTiers::counters;
  report.ended_early = runs.add_until(timed ? BaselineDesign{}.stored_runs : 1, {});
  describe(runs, report);
  report.noise = noise_of(runs.values);
  const std::string noise = timed ? noise_text(*report.noise) : "";
  if (!noise.empty() || !report.ended_early.empty()) {
    report.verdict = noise.empty() ? Verdict::inconclusive : Verdict::noisy;
    report.reason = noise;
    report.advice = runs.advice(options, BaselineDesign{}.stored_runs);
    for (const std::string& more : {report.ended_early, std::string("nothing was stored"), report.advice}) {
      if (!more.empty()) report.reason += (report.reason.empty() ? "" : "; ") + more;
    }
    return;
  }
  const Measurement& first = runs.measured.front();
  write_whole_file(options.save, baseline_text({first.program, runs.frames(), first.fingerprint, runs.values,
                                                counter_ranges(runs.measured)}));
  report.verdict = Verdict::ok;
  report.reason = counted(static_cast<std::int64_t>(runs.measured.size()), "run", "runs") + " stored in " +
                  printable(options.save.string());
}

void check_baseline(const CheckOptions& options, const TimeLimit& limit, CheckReport& report) {
  const Baseline baseline = read_baseline(options.baseline);
  report.baseline = printable(options.baseline.string()) + " (" + printable(baseline.program) + ")";
  report.baseline_runs = static_cast<int>(baseline.runs.size());
  const MeasuredProgram program = candidate_of(options);
  // The same frames as then, whatever they take here; another choice would be other work.
  const std::int64_t frames = options.run.replay.frames.value_or(baseline.frames);
  Runs runs(program, frames, limit);
  runs.add();
  const CheckFingerprint& now = runs.measured.front().fingerprint;
  // The stored runs were given other flags than these: a setting that they do not know had its default.
  report.differences = told_differences(differences(baseline.fingerprint.work, now.work), options.allowed,
                                        "the baseline did other work");
  const std::string other_machine = machine_difference(baseline.fingerprint, now);
  const bool timed = options.tiers != CheckedTiers::counters;
  if (timed && other_machine.empty()) {
    report.ended_early = runs.add_until(BaselineDesign{}.runs, baseline.runs);
    judge_times(baseline, runs, report);
    report.advice = advice_of(options, baseline, runs, report);
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
