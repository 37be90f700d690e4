#include "server/check/run_length.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "server/check/measure/measure_run.h"
#include "server/results/fingerprint.h"
#include "server/text/number_text.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

constexpr std::int64_t kPilotFrames = 30;
constexpr double kFewestMeasuredFrames = 20;  // a median of fewer is one frame's luck

}  // namespace

MeasuredProgram candidate_of(const CheckOptions& options) {
  std::vector<std::string> arguments;
  if (options.run.slow_down_percent > 0) {
    arguments = {"--slow-down", shortest_text(options.run.slow_down_percent)};
  }
  arguments.insert(arguments.end(), options.run_arguments.begin(), options.run_arguments.end());
  return MeasuredProgram::this_one(std::move(arguments));
}

std::int64_t frames_of_run(const CheckOptions& options, const MeasuredProgram& candidate,
                           const TimeLimit& limit) {
  if (options.run.replay.frames) return *options.run.replay.frames;
  if (options.tiers == CheckedTiers::counters) return kPilotFrames;
  const Measurement pilot = candidate.measure(kPilotFrames, limit);
  double pilot_ms = 0;
  for (std::size_t i = 0; i < pilot.frame_ms.size(); ++i) {
    pilot_ms += pilot.frame_ms[i] + pilot.calibration_rays_ms[i] + pilot.calibration_memory_ms[i];
  }
  const double frame_ms = pilot_ms / static_cast<double>(pilot.frame_ms.size());
  const double measured = std::max(options.run_seconds * 1e3 / frame_ms, kFewestMeasuredFrames);
  // With as many to warm up as a long run has. A session that is shorter is taken whole.
  constexpr std::int64_t kLongRun = 1 << 20;
  return std::min(std::llround(measured), static_cast<long long>(kLongRun)) + warm_up_frames(kLongRun);
}

std::string settings_line(const CheckFingerprint& fingerprint) {
  constexpr std::array<std::string_view, 8> kAlwaysTold{"--scene",         "--profile",        "--polar",
                                                        "--light-samples", "--occlusion-rays", "--probes",
                                                        "--isa",           "--threads"};
  // A check writes no pictures and has no policy.
  constexpr std::array<std::string_view, 4> kNeverTold{"--format", "--contact-sheet", "--polar-floor",
                                                       "--polar-floor-height"};
  const Fingerprint::Entries defaults = setting_entries({});
  const auto& work = fingerprint.work.settings;
  const bool no_short_rays =
      std::find(work.begin(), work.end(), std::pair<std::string, std::string>("--occlusion-rays", "0")) !=
      work.end();
  std::string line;
  for (const auto* entries : {&fingerprint.work.settings, &fingerprint.machine}) {
    for (const auto& entry : *entries) {
      const auto named = [&](const auto& other) { return other.first == entry.first; };
      const auto other = std::find_if(defaults.begin(), defaults.end(), named);
      const bool always = std::find(kAlwaysTold.begin(), kAlwaysTold.end(), entry.first) != kAlwaysTold.end();
      if (!always && (other == defaults.end() || other->second == entry.second)) continue;
      if (std::find(kNeverTold.begin(), kNeverTold.end(), entry.first) != kNeverTold.end()) continue;
      if (no_short_rays && entry.first == "--no-occlusion-smoothing") continue;  // a mean over none
      line += (line.empty() ? "" : ", ") + flags_of(entry);
    }
  }
  return line;
}

std::vector<CheckedTime> told_times(std::span<const RunValues> candidate, std::span<const RunValues> baseline,
                                    ShiftOf shift_of) {
  struct Told {
    const char *name, *title;
    double RunValues::*value;
  };
  constexpr std::array<Told, 3> kTold{
      {{"median", "median", &RunValues::median},
       {"p95", "95th percentile", &RunValues::p95},
       {"worst_5_percent", "slowest 5 %, mean", &RunValues::worst_twentieth}}};
  std::vector<CheckedTime> times;
  for (const Told& told : kTold) {
    CheckedTime time;
    time.name = told.name, time.title = told.title;
    time.shift = shift_of(logarithms(candidate, told.value), logarithms(baseline, told.value));
    times.push_back(time);
  }
  times.front().decides = true;
  return times;
}

// The one that grew most of those with this verdict, and how many more there are.
std::string counters_text(const std::vector<CounterJudgement>& counters, Verdict verdict) {
  const auto growth = [](const CounterJudgement& one) {
    return one.baseline > 0 ? one.candidate / one.baseline : std::numeric_limits<double>::infinity();
  };
  const CounterJudgement* most = nullptr;
  std::int64_t count = 0;
  for (const CounterJudgement& counter : counters) {
    if (counter.verdict != verdict) continue;
    ++count;
    if (most == nullptr || growth(counter) > growth(*most)) most = &counter;
  }
  if (most == nullptr) return {};
  const std::string text = most->reason.empty()
                               ? "more " + most->name + " than before, " + counter_change_text(*most) +
                                     " (limit +" + fixed_text(100 * kCounterLimit, 1) + " %)"
                               : most->name + " " + most->reason;
  return count == 1 ? text : text + ", and " + counted(count - 1, "more counter", "more counters");
}

void conclude(CheckReport& report) {
  report.verdict = Verdict::ok;
  report.reason.clear();
  const auto add = [&](Verdict verdict, const std::string& reason) {
    if (worse_of(report.verdict, verdict) == report.verdict) return;
    report.verdict = verdict;
    report.reason = reason;
  };
  if (!report.counters.empty()) {
    Verdict worst = Verdict::ok;
    for (const CounterJudgement& counter : report.counters) worst = worse_of(worst, counter.verdict);
    add(worst, counters_text(report.counters, worst));
  }
  for (const CheckedTime& time : report.times) {
    if (!time.decides) continue;
    const std::string slower = slower_text(time.shift.estimate) + " (limit +" +
                               fixed_text(100 * time.rule.limit, 0) + " %, p " + p_text(time.shift.p) + ")";
    add(time.verdict, time.reason.empty() ? slower : time.reason);
    if (report.verdict == Verdict::ok) report.reason = slower;
  }
  report.reason = with_remarks(report.reason, report, report.verdict, true);
}

}  // namespace herr
