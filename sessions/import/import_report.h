// What an import read, wrote, left out and assumed. Nothing is repaired without being counted here.
// Before: import_rows. After: the program prints it; session.json keeps what was left out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sessions/format/pose.h"
#include "sessions/import/rows/head_reader.h"
#include "sessions/import/stamps/row_fate.h"
#include "sessions/import/tables/row_source.h"
#include "sessions/streams/interval_census.h"

namespace herr {

struct ImportedStream {
  std::filesystem::path file;
  std::int64_t rows_read = 0, rows = 0;  // rows: written
  bool lost_rows_stay = false;           // gaze: a row without tracking is written as not valid, no loss
  TimeNs first_ns = 0, last_ns = 0;
  IntervalCensus intervals;

  RowFateCounts fates;
  std::string
      first_absent;  // poses: "px is 'nan'" of the first row without tracking; empty: a filter says so
  std::vector<std::string> remarks;  // what the clock did: whole sentences
  std::int64_t sorted_rows = 0;      // put where they belong
  std::int64_t one_eye_rows = 0;     // gaze of one eye only
  std::int64_t repeated_values = 0;  // the same numbers as the row before: the tracker is slower than the log
  ReadingCounts reading;
  RowSourceCounts source;

  double rate_hz() const { return intervals.median_ns() > 0 ? 1e9 / intervals.median_ns() : 0; }
  // How many rows that met this fate are not in the session, and are no second view of what is.
  std::int64_t lost(RowFate fate) const;
  // Share of the rows read that are lost, 0 to 1.
  double lost_share() const;
};

struct ImportReport {
  ImportedStream poses, gaze;
  bool has_gaze = false;
  bool gaze_combined = false;
  TimeNs shift_ns = 0;                // added to every stamp
  std::vector<std::string> assumed;   // "the head stands still at the origin", whole sentences
  std::vector<std::string> remarks;   // where ids change, what never changes: whole sentences, one each
  std::vector<std::string> warnings;  // one line each, "FILE:LINE: ...; ..."; the first hundred
};

// A share of lost rows above this makes the result partial.
inline constexpr double kPartialShare = 0.05;

}  // namespace herr
