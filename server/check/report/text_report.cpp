#include "server/check/report/text_report.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "server/check/statistics/pair_design.h"
#include "server/process/version.h"
#include "server/text/number_text.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kNameWidth = 26, kBoundsWidth = 23;  // "-100.0 % ... +1000.0 %" and a space

std::string limit_text(double limit) {
  return "+" + fixed_text(100 * limit, limit < 0.01 ? 1 : 0) + " %";
}

std::string ms_text(const std::optional<double>& ms) {
  return ms ? fixed_text(*ms, 2) + " ms" : "n/a";
}

std::string time_rows(const CheckReport& report) {
  std::string text = left_aligned("frame time, calibrated", kNameWidth) + right_aligned("change", 9) +
                     right_aligned("bounds", kBoundsWidth) + right_aligned("p", 11) +
                     right_aligned("limit", 8) + "  verdict\n";
  for (const CheckedTime& time : report.times) {
    const bool known = time.verdict != Verdict::not_comparable;
    text += left_aligned(time.title, kNameWidth) +
            right_aligned(known ? change_text(time.shift.estimate) : "", 9) +
            right_aligned(known ? bounds_text(time.shift) : "", kBoundsWidth) +
            right_aligned(known ? p_text(time.shift.p) : "", 11) +
            right_aligned(time.decides ? limit_text(time.rule.limit) : "", 8) + "  " +
            (time.decides ? name_of(time.verdict) : "told only") + "\n";
  }
  return text;
}

std::string counter_rows(const CheckReport& report) {
  std::string text = left_aligned("counter, per frame", kNameWidth) + right_aligned("baseline", 14) +
                     right_aligned("candidate", 14) + right_aligned("change", 10) +
                     right_aligned("limit", 8) + "  verdict\n";
  for (const CounterJudgement& counter : report.counters) {
    text += left_aligned(counter.name, kNameWidth) + right_aligned(fixed_text(counter.baseline, 1), 14) +
            right_aligned(fixed_text(counter.candidate, 1), 14) +
            right_aligned(counter_change_text(counter), 10) + right_aligned(limit_text(kCounterLimit), 8) +
            "  " + name_of(counter.verdict) + "\n";
  }
  return text;
}

std::string steal_text(double share) {
  return std::isfinite(share) ? fixed_text(100 * share, 1) + " %" : "an unknown share";
}

// Infinite bounds are null.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json ratio(double logarithm) {
  return number(std::exp(logarithm));
}

}  // namespace

std::string check_text(const CheckReport& report) {
  std::string text;
  if (!report.candidate.empty()) {
    const bool stored = report.baseline_runs == 0;  // nothing to compare with
    text += report.session + ": " + report.candidate + (stored ? "" : " against " + report.baseline) + "\n" +
            report.settings + "\n" + counted(report.runs, "run", "runs") + " of " +
            counted(report.frames, "frame", "frames") +
            (stored ? "" : " against " + std::to_string(report.baseline_runs)) + "\n";
    for (const AllowedDifference& part : differences_by_part(report)) {
      text += "differs, as allowed: " + part.part + ": " + part.text + "\n";
    }
    text += "\n";
  }
  if (report.baseline_ms && report.candidate_ms) {
    text += "median frame, not calibrated: " + ms_text(report.baseline_ms) + " -> " +
            ms_text(report.candidate_ms) + "\n";
  }
  if (!report.times.empty()) text += time_rows(report) + "\n";
  if (!report.counters.empty()) text += counter_rows(report) + "\n";
  if (report.noise) {
    text += "machine: speed varied by " + fixed_text(100 * report.noise->calibration_cv, 1) +
            " % from run to run, " + steal_text(report.noise->steal) + " of the CPU time was stolen\n";
  }
  return text + headline(report) + "\n";
}

Json check_json(const CheckReport& report) {
  Json times = Json::array(), counters = Json::array();
  for (const CheckedTime& time : report.times) {
    const bool known = time.verdict != Verdict::not_comparable;
    Json json{{"name", time.name}, {"decides", time.decides}};
    if (time.decides) json["verdict"] = name_of(time.verdict), json["limit"] = 1 + time.rule.limit;
    json["ratio"] = known ? ratio(time.shift.estimate) : Json(nullptr);
    json["lower"] = known ? ratio(time.shift.lower) : Json(nullptr);
    json["upper"] = known ? ratio(time.shift.upper) : Json(nullptr);
    json["p"] = known ? Json(time.shift.p) : Json(nullptr);
    if (!time.reason.empty()) json["reason"] = time.reason;
    times.push_back(json);
  }
  for (const CounterJudgement& counter : report.counters) {
    Json json{{"name", counter.name},
              {"verdict", name_of(counter.verdict)},
              {"limit", 1 + kCounterLimit},
              {"baseline", counter.baseline},
              {"candidate", counter.candidate}};
    if (!counter.reason.empty()) json["reason"] = counter.reason;
    counters.push_back(json);
  }
  Json differences = Json::array();
  for (const AllowedDifference& difference : report.differences) {
    differences.push_back({{"part", difference.part}, {"difference", difference.text}});
  }
  Json json{{"format_version", 1},
            {"program", program_with_version()},
            {"session", report.session},
            {"candidate", report.candidate},
            {"baseline", report.baseline},
            {"settings", report.settings},
            {"verdict", report.error.empty() ? name_of(report.verdict) : "error"},
            {"reason", report.error.empty() ? report.reason : report.error},
            {"runs", report.runs},
            {"baseline_runs", report.baseline_runs},
            {"frames_per_run", report.frames},
            {"seconds", report.seconds},
            {"ended_early", report.ended_early.empty() ? Json(nullptr) : Json(report.ended_early)},
            {"advice", report.advice.empty() ? Json(nullptr) : Json(report.advice)},
            {"differences", differences},
            {"candidate_frame_ms", report.candidate_ms ? number(*report.candidate_ms) : Json(nullptr)},
            {"baseline_frame_ms", report.baseline_ms ? number(*report.baseline_ms) : Json(nullptr)},
            {"times", times},
            {"counters", counters}};
  json["noise"] = report.noise ? Json{{"calibration_cv", number(report.noise->calibration_cv)},
                                      {"steal", number(report.noise->steal)}}
                               : Json(nullptr);
  json["definitions"] = {
      {"ratio", "candidate / baseline of frame times over the calibration beside them; Hodges-Lehmann"},
      {"lower, upper", "one-sided bounds; of the time that decides, 95 % for all looks together"},
      {"p", "exact Wilcoxon, one-sided; of the time that decides, for all looks together"},
      {"candidate_frame_ms", "median over runs of the median frame time, not calibrated"},
      {"seconds", "that the whole check took"},
      {"ended_early",
       "why there are fewer runs than the design may ask for; null: a verdict, or all of them"},
      {"advice", "what would let times that could not tell decide; null: they could, or nothing is known"},
      {"differences", "that --allow-different let pass, all of them"},
      {"calibration_cv", "1.4826 median absolute deviations over the median, of the runs' bare rays"},
      {"steal", "stolen CPU time over used and stolen"},
      {"counters", "per frame; more than the limit is a regression, less is not"}};
  return json;
}

}  // namespace herr
