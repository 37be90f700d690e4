// What would let a check decide that could not tell: how many more pairs or runs and the flag that allows
// them, or that no number of them would help. Before: check_against, check_baseline. After:
// CheckReport::advice.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/check/statistics/noise.h"

namespace herr {

// Where --max-seconds ended a check that further pairs or runs could decide.
struct MoreRuns {
  const char *one, *several;            // "pair", "pairs"
  int fewest = 1, most = 1;             // more that it takes at least; that the design may ask for
  double used_s = 0, seconds_each = 0;  // so far; of one more
};
// "it takes 3 more pairs at least, 18 at most: --max-seconds 210", with room for a fifth more time than so
// far.
std::string more_runs_advice(const MoreRuns& more);

// Of a machine that no more pairs or runs make quiet enough: "no number of pairs helps: ...".
std::string noisy_advice(const Noise& noise, const char* several);

// Of bounds that stay too wide although all pairs are done: longer runs, by the flag that says their length.
std::string longer_runs_advice(std::optional<std::int64_t> frames, double run_seconds);

}  // namespace herr
