// What an import read, wrote and repaired. Nothing is repaired without being counted here.
// Before: import_rows. After: the program prints it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sessions/format/pose.h"
#include "sessions/streams/interval_census.h"

namespace herr {

struct ImportedStream {
  std::filesystem::path file;
  std::int64_t rows = 0;  // written
  TimeNs first_ns = 0, last_ns = 0;
  IntervalCensus intervals;

  std::int64_t repeated_stamps = 0;  // left out: the first of equal stamps is kept
  std::int64_t backward_stamps = 0;  // left out: earlier than the row before
  std::int64_t lost_rows = 0;        // poses: left out; gaze: written as not valid for both eyes
  std::int64_t one_eye_rows = 0;     // gaze of one eye only
  std::int64_t repeated_values = 0;  // the same numbers as the row before: the tracker is slower than the log
  std::int64_t blank_lines = 0;
  std::int64_t bad_rows = 0;         // keep_going: left out
  std::int64_t normalised_rows = 0;  // quaternions or directions whose length was off by more than rounding

  double rate_hz() const { return intervals.median_ns() > 0 ? 1e9 / intervals.median_ns() : 0; }
};

struct ImportReport {
  ImportedStream poses, gaze;
  bool has_gaze = false;
  bool gaze_combined = false;
  std::vector<std::string> warnings;  // one line each, "FILE:LINE: ...; ..."; the first hundred
};

}  // namespace herr
