// The answer of `herr study --hz` for people and machines. Before: RateAnswer. After: stdout; warnings for
// stderr.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "server/study/rate/rate_run.h"

namespace herr {

// What was asked, and of what.
struct RateQuestion {
  double hz = 90;
  std::string profile;       // its name
  std::string command_line;  // that renders `held`; empty without
  std::string try_next;      // where nothing holds: the line that asks for less; or empty
  std::string try_words = "without what flags leave out";  // what it asks for
};

// Two sentences, a line each: the largest setting that holds, and what prevents more, with the flags that
// leave that out; where one holds what that is to a viewer, and the rate at all pixels of the display if that
// was measured; then where in the session it was measured. Below them the line to be pasted: that renders
// what holds, or where none does the question that asks for less.
std::string rate_text(const RateQuestion& question, const RateAnswer& answer);
// One for a machine that was busy, one for percentiles that scatter by more than a tenth; mostly none.
std::vector<std::string> rate_warnings(const RateAnswer& answer);
// Of a search that the time ended with settings open: "--minutes 0.1 ended the search after 2 runs; ... give
// --minutes 1 or more".
std::string too_few_minutes_text(double minutes, double seconds, const RateAnswer& answer);
// {"hz", "period_ms", "holds", "command_line", "held", "prevented_by", "ended_early", "open_settings",
// "machine", "warnings", "tried"}; null: there is none.
nlohmann::ordered_json rate_json(const RateQuestion& question, const RateAnswer& answer);
// 0, or 1 when not even the smallest setting holds; 4 when that may be the fault of a busy machine. Where the
// time ended the search with settings open: 5 with one that holds, 4 without.
int rate_exit_code(const RateAnswer& answer);

}  // namespace herr
