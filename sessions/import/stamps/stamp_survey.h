// A first pass over the stamps of a stream, which tells what its clock did before any row is used: wild stamps,
// a clock that starts again, equal stamps, interleaved cameras, a second recording behind the first.
// Before: RowSource, TimeReader. After: import_rows leaves out the lines named here and says why.
// Bounded memory: runs of rows, not rows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sessions/format/pose.h"
#include "sessions/import/stamps/row_fate.h"
#include "sessions/import/rows/time_reader.h"

namespace herr {

// Rows from one line to another that are left out.
struct LeftOutLines {
  std::int64_t first_line = 0, last_line = 0;
  RowFate fate = RowFate::wild_stamp;
};

struct StampSurvey {
  std::int64_t rows = 0;  // with a legible stamp
  TimeNs first_ns = 0, last_ns = 0, lowest_ns = 0;  // of the rows that stay
  double usual_step_ns = 0;                         // between neighbours, 0 when there are none
  std::vector<LeftOutLines> left_out;               // by line
  // Pairs of stamps much closer than the usual step (several cameras in one table): the second of each pair is
  // left out as thinned. 0: none.
  TimeNs thin_below_ns = 0;
  bool all_equal = false;
  // What a reader should be told, whole sentences: "the clock starts again at line 62". May be empty.
  std::vector<std::string> remarks;
};

// Reads `rows` to its end. Illegible stamps and bad rows are passed over: the second pass meets them again.
StampSurvey survey_stamps(RowSource& rows, TimeReader& time);

}  // namespace herr
