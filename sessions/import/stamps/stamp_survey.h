// A first pass over the stamps of a stream, which tells what its clock did before any row is used: wild
// stamps, a clock that starts again, equal stamps, interleaved cameras, a second recording behind the first.
// Before: RowSource, TimeReader. After: import_rows leaves out the lines named here and says why.
// Bounded memory: runs of rows, not rows.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sessions/format/pose.h"
#include "sessions/import/rows/time_reader.h"
#include "sessions/import/stamps/row_fate.h"

namespace herr {

// Where a row begins: its line, and how many rows begin in that line before it (XML may be one long line).
struct RowPlace {
  std::int64_t line = 0, nth = 0;

  // The place of the next row, which begins in `next_line`.
  void move_to(std::int64_t next_line) {
    nth = next_line == line ? nth + 1 : 0;
    line = next_line;
  }
  auto operator<=>(const RowPlace&) const = default;
};

// Rows from one place to another, both included, that are left out.
struct LeftOutRows {
  RowPlace first, last;
  RowFate fate = RowFate::wild_stamp;
};

struct StampSurvey {
  std::int64_t rows = 0;                            // with a legible stamp
  TimeNs first_ns = 0, last_ns = 0, lowest_ns = 0;  // of the rows that stay
  double usual_step_ns = 0;                         // between neighbours, 0 when there are none
  std::vector<LeftOutRows> left_out;                // in the order of the file
  // Pairs of stamps much closer than the usual step (several cameras in one table): the second of each pair
  // is left out as thinned. 0: none.
  TimeNs thin_below_ns = 0;
  bool all_equal = false;
  std::int64_t carried_line = 0;  // where stamps that name no day start again (TimeReader::carried_ns), or 0
  // What a reader should be told, whole sentences: "the clock starts again at line 62". May be empty.
  std::vector<std::string> remarks;
};

// Reads `rows` to its end, or `most_rows` of them (0: all). Illegible stamps and bad rows are passed over:
// the second pass meets them again. `sort_rows`: rows that come at most so many rows late stay, to be sorted.
StampSurvey survey_stamps(RowSource& rows, TimeReader& time, std::size_t sort_rows = 0,
                          std::int64_t most_rows = 0);

}  // namespace herr
