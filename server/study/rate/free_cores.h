// Roughly what a rate's search would have found while nobody else had the cores: an estimate from the CPU
// time of the frames that were measured, never the answer. Before: RateAnswer of a busy machine. After: a
// warning, and a field of the JSON.
#pragma once

#include <optional>
#include <string>

#include "server/study/rate/rate_run.h"

namespace herr {

struct FreeRate {
  RateSetting setting;
  double p95_ms = 0;  // the median of its trials' free_p95_ms
};

// Of the settings that were measured: the largest below the first that would not hold, and that one; what
// lies between was not measured. One of them is there.
struct FreeCores {
  std::optional<FreeRate> holds, refused;
};

// None of a machine that was not busy, where CPU times are not known, and where nothing was measured.
std::optional<FreeCores> free_cores_of(const RateAnswer& answer);

// "a setting that holds is polar 788x384 … (about 8.40 ms), one that does not polar … (about 13.10 ms)".
std::string free_cores_text(const FreeCores& free);

}  // namespace herr
