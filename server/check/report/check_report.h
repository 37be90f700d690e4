// What a check found, as plain data: every report is made from it. Before: check_against, check_baseline.
// After: text, JSON, Markdown, JUnit XML, annotations; the exit code.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/check/statistics/counter_gate.h"
#include "server/check/statistics/noise.h"
#include "server/check/statistics/verdict.h"

namespace herr {

// A time of which two programs have a distribution each.
struct CheckedTime {
  std::string name;                         // "median", "p95", "worst_5_percent"
  std::string title;                        // for people
  bool decides = false;                     // the others are told and never fail
  Verdict verdict = Verdict::inconclusive;  // where it decides
  std::string reason;                       // one line, where the verdict is not plain from the numbers
  Shift shift;                              // of logarithms of calibrated times, candidate over baseline
  ShiftRule rule;
};

// What differs between the two and was allowed to.
struct AllowedDifference {
  std::string part;  // "scene", "settings", "session"
  std::string text;  // "general.scene.json has changed"
};

struct CheckReport {
  std::string session;              // its folder's name
  std::string candidate, baseline;  // what was compared: programs with versions, or a file
  std::string settings;             // "--profile xr1-half, ..., --threads 2": what ran, in one line
  Verdict verdict = Verdict::inconclusive;
  std::string reason;  // one line that explains the verdict
  std::string error;   // the check itself failed: one line, and no verdict; empty otherwise

  std::vector<CounterJudgement> counters;
  std::vector<CheckedTime> times;
  std::optional<double> baseline_ms, candidate_ms;  // median frame times, not calibrated
  std::optional<Noise> noise;
  int runs = 0, baseline_runs = 0;  // measured; for pairs both are the number of pairs
  std::string ended_early;  // why there are no more, one line; empty where the design asks for no more
  std::string advice;       // what would let times that could not tell decide, one line; may be empty
  std::vector<AllowedDifference> differences;  // that --allow-different let pass
  std::int64_t frames = 0;                     // measured in each run
  double seconds = 0;                          // that the whole check took: all runs of both programs
};

// 0 ok, 1 regression, 4 anything else.
int exit_code_of(Verdict verdict);

// "+8.1 %" for the logarithm of a ratio that is finite.
std::string change_text(double logarithm);
// "+6.0 % ... +10.2 %"; "+6.0 % at least" and "+10.2 % at most" with one bound; "none, too few runs" without.
std::string bounds_text(const Shift& shift);
// Of what is counted: "+0.5 %", "from 0".
std::string counter_change_text(const CounterJudgement& counter);
// "frames take 8.1 % more time".
std::string slower_text(double logarithm);
// Why a shift was neither found to be a regression nor found not to be.
std::string open_text(const Shift& shift);
// A p-value with five decimals.
std::string p_text(double p);
// A finding with all that is said of the whole check: "...; --max-seconds ended it ...; it takes 3 more pairs
// ...; settings differ, as allowed". Advice is for times that could not tell.
std::string with_remarks(const std::string& finding, const CheckReport& report, Verdict verdict,
                         bool of_times);
// "scene and settings differ, as allowed"; empty where nothing differs.
std::string differences_text(const CheckReport& report);
// A line for each part: "scene: --scene was a, is b; general.scene.json has changed; and 5 more".
std::vector<AllowedDifference> differences_by_part(const CheckReport& report);
// The verdict in capitals with its reason: "REGRESSION: ...".
std::string headline(const CheckReport& report);

}  // namespace herr
