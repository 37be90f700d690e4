#include "sessions/import/stamps/stamp_remarks.h"

#include <algorithm>
#include <cmath>

#include "sessions/text/plain_values.h"

namespace herr {
namespace {

constexpr double kMuchDisorder = 0.2;        // of the rows
constexpr double kManyEqual = 0.05;          // of the rows
constexpr TimeNs kPauseNs = 60'000'000'000;  // and more than StampRuns::far: worth a word

std::string seconds_text(double ns) {
  return plain_number_text(ns / 1e9) + " s";
}

// Of a pause; from two days on also in days.
std::string pause_text(double ns) {
  constexpr double kDayNs = 86'400e9;
  return seconds_text(ns) +
         (ns < 2 * kDayNs ? "" : " (" + std::to_string(std::llround(ns / kDayNs)) + " days)");
}

std::string of_rows(std::int64_t some, const ClockCounts& clock) {
  return std::to_string(some) + " of " + std::to_string(clock.rows) + " rows";
}

// The runs of another clock: where the first of them stands, and what its stamps say beside those that stay.
std::string reset_remark(const ClockCounts& clock, const StampRuns& stamps) {
  const std::vector<StampRun>& runs = stamps.runs();
  std::int64_t rows = 0;
  std::size_t first = runs.size();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].kept || runs[i].rows <= StampRuns::kWildRows) continue;
    rows += runs[i].rows;
    first = std::min(first, i);
  }
  if (rows == 0) return {};
  std::size_t before = first, after = first;
  while (before > 0 && !runs[before].kept) --before;
  while (after + 1 < runs.size() && !runs[after].kept) ++after;
  const std::string line = std::to_string(runs[first].first.line);
  if (!runs[before].kept)
    return of_rows(rows, clock) + " lie before line " + std::to_string(runs[after].first.line) +
           ", where the clock was reset and a longer recording begins: they were left out";
  if (runs[first].lowest_ns <= runs[before].highest_ns)
    return of_rows(rows, clock) + " lie before the newest stamp: the clock was reset at line " + line;
  return of_rows(rows, clock) + " from line " + line + " on lie " +
         seconds_text(static_cast<double>(runs[first].first_ns - runs[before].highest_ns)) +
         " ahead of those that follow them: the clock jumped there and back";
}

std::string pause_remark(const StampRuns& stamps) {
  const StampRun* before = nullptr;
  std::int64_t pauses = 0;
  std::string text;
  for (const StampRun& run : stamps.runs()) {
    if (!run.kept) continue;
    if (before != nullptr && stamps.far(before->highest_ns, run.first_ns) &&
        run.first_ns - before->highest_ns > kPauseNs && pauses++ == 0)
      text = "the recording pauses for " +
             pause_text(static_cast<double>(run.first_ns - before->highest_ns)) + " at line " +
             std::to_string(run.first.line) + ": two recordings in one file?";
    before = &run;
  }
  if (pauses > 1) text += " (and " + std::to_string(pauses - 1) + " more such pauses)";
  return text;
}

}  // namespace

std::vector<std::string> stamp_remarks(const ClockCounts& clock, const StepPattern& pattern,
                                       const StampRuns& runs) {
  std::vector<std::string> remarks;
  const auto add = [&](std::string text) {
    if (!text.empty()) remarks.push_back(std::move(text));
  };
  if (runs.too_many())
    add("the stamps jump more than " + std::to_string(StampRuns::kMost) + " times (" +
        of_rows(clock.backward, clock) +
        " go backwards): every row that is newer than all before it was kept");
  else if (static_cast<double>(clock.backward) > kMuchDisorder * static_cast<double>(clock.rows))
    add(of_rows(clock.backward, clock) + " go backwards: are they in another order than that of time?");
  add(reset_remark(clock, runs));
  add(pause_remark(runs));
  if (pattern.usual_ns > 0 && static_cast<double>(clock.equal) > kManyEqual * static_cast<double>(clock.rows))
    add(of_rows(clock.equal, clock) + " have the stamp of the row before (" +
        seconds_text(static_cast<double>(clock.equal_ns)) + " in line " + std::to_string(clock.equal_line) +
        "), and distinct stamps are " + seconds_text(pattern.usual_ns) +
        " apart: written in single precision, or by a clock that is slower than the log?");
  if (pattern.cameras > 0)
    add("poses at the stamps of " + std::to_string(pattern.cameras) + " cameras in one table: of stamps " +
        plain_number_text(pattern.within_ns / 1e6) + " ms apart the first was kept");
  return remarks;
}

}  // namespace herr
