// What `herr check` is asked to do. Before: check_flags fills it. After: check_command.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "server/check/allowed_differences.h"
#include "server/check/measure/measure_options.h"

namespace herr {

// Which tiers decide: work that is counted, times, or both.
enum class CheckedTiers { all, counters, times };

struct CheckOptions {
  MeasureOptions run;                      // what each measured run renders; one session
  std::vector<std::string> run_arguments;  // the same as written, for the processes that measure
  std::filesystem::path against;           // another build of this program; empty: none
  std::filesystem::path baseline;          // stored runs to compare with; empty: none
  std::filesystem::path save;              // where to store runs; empty: nowhere
  CheckedTiers tiers = CheckedTiers::all;
  double run_seconds = 1.5;               // length of a measured run, where --frames does not say it
  std::optional<double> max_seconds;      // that the whole check may take
  AllowedDifferences allowed;             // between the two that are compared
  bool overwrite = false;                 // replace the file of --save
  bool json = false;                      // the report on stdout as JSON
  std::filesystem::path markdown, junit;  // reports as files; markdown is appended
  bool github_annotations = false;        // workflow commands on stdout after the report
  bool measure = false;                   // be one measured run: print its record and nothing else
};

// What no single flag can know. Throws UsageError.
void check_check_options(const CheckOptions& options);

}  // namespace herr
