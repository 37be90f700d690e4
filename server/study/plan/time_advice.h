// What to type where the time of a study is enough for too few of its settings, told as soon as that is
// foreseen. Before: what the first default took. After: one line on stderr, and a warning of the report.
#pragma once

#include <cstddef>
#include <string>

namespace herr {

// Of all settings: with fewer a choice among them would be none.
inline constexpr double kLeastShareForAdvice = 0.25;

struct TimeShortage {
  std::size_t planned = 0, settings = 0;  // that are expected to fit, and that there are
  double minutes = 0;                     // of the study
  double minutes_needed = 0;              // for kLeastShareForAdvice of the settings
  std::size_t only = 0;                   // names in --only; 0: all sweeps
  std::string references;                 // folder of those that this study made; empty: it found them
  double references_s = 0;                // that making them took
  double profile_scale = 1;
};

// One line: how few settings fit, and what helps, most first; empty where kLeastShareForAdvice of them fit.
std::string too_few_settings(const TimeShortage& shortage);

// In whole minutes, a quarter more than foretold, and more than `minutes`: of a study that has spent
// `rows_s` on settings and wants `more_s` for others, where its references take `references_s` and, once they
// are half of the time, no more (`all_frames`: those of all frames are made).
double minutes_for(double minutes, double references_s, double rows_s, double more_s, bool all_frames);

}  // namespace herr
