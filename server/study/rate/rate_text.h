// The answer of `herr study --hz` for people. Before: RateAnswer, RateChain. After: stdout; warnings for
// stderr.
#pragma once

#include <string>
#include <vector>

#include "server/study/rate/rate_chain.h"

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
// Where steps came after what was asked: that this does not hold, then the same of the last step with its
// changes.
std::string rate_text(const RateQuestion& question, const RateChain& chain);

// One for a machine that was busy and one for what it would hold otherwise, as an estimate; one for
// percentiles that scatter by more than a tenth; mostly none.
std::vector<std::string> rate_warnings(const RateAnswer& answer);
// Busy: of all steps. The estimate: of what was asked, and of the last step.
std::vector<std::string> rate_warnings(const RateChain& chain);
// Where the time ended the search with settings open, or before the next step: "--minutes 0.1 ended the
// search after 2 runs, and it takes about 6 more; give --minutes 1 or more"; else empty.
std::string too_few_minutes_text(double minutes, double seconds, const RateChain& chain);

// 0, or 1 when not even the smallest setting holds; 4 when that may be the fault of a busy machine. Where the
// time ended the search with settings open: 5 with one that holds, 4 without.
int rate_exit_code(const RateAnswer& answer);
// That of what was asked: what holds with changes alone makes no 0 of it.
int rate_exit_code(const RateChain& chain);

}  // namespace herr
