// The file of `herr check --save`: runs with everything that says whether later ones compare.
// Before: save_baseline. After: check_baseline, on another day.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/check/measure/measurement.h"
#include "server/check/measure/run_values.h"

namespace herr {

struct Baseline {
  std::string program;
  std::int64_t frames = 0;  // that each run was asked for, those that warm up included
  CheckFingerprint fingerprint;
  std::vector<RunValues> runs;  // without CPU times
  std::vector<CounterRange> counters;
};

std::string baseline_text(const Baseline& baseline);
// Throws InputError for a damaged file, NotComparable for one of another format or calibration.
Baseline read_baseline(const std::filesystem::path& file);

}  // namespace herr
