// The rows of one stream of a foreign file that the survey of its stamps leaves in, in the order of the file.
// Before: open_rows, TimeReader, StampSurvey. After: ordered_rows puts them in order of time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/import/import_report.h"
#include "sessions/import/import_rows.h"
#include "sessions/import/map/column_map.h"
#include "sessions/import/rows/time_reader.h"
#include "sessions/import/stamps/stamp_survey.h"
#include "sessions/import/tables/row_source.h"

namespace herr {

// Where a stream stands. Refers to the map.
struct StreamFile {
  std::filesystem::path path;
  const TableFormat* table = nullptr;
  const TimeColumns* time = nullptr;
  std::vector<ColumnRef> wanted;  // all columns that its readers ask for
  TimeNs later_ns = 0;  // added to its stamps: a day where they name none and another file's began before
};

// Reads the file's stamps. Throws InputError where all of them are equal.
StampSurvey survey_file(const StreamFile& file, const ImportRequest& request);

// Dates of which neither the map nor the first legible row names a zone are taken as UTC.
bool assumes_utc(const StreamFile& file);

// One line each, at most a hundred.
class Warnings {
 public:
  explicit Warnings(std::vector<std::string>& texts) : texts_(texts) {}
  void add(const InputError& error, const std::string& then);

 private:
  std::vector<std::string>& texts_;
};

class StreamCursor {
 public:
  // Stream, survey and warnings must outlive it. `shift_ns` is added to every stamp. Throws InputError.
  StreamCursor(const StreamFile& file, const StampSurvey& survey, TimeNs shift_ns, bool keep_going,
               ImportedStream& stream, Warnings& warnings);

  RowSource& rows() { return *rows_; }  // places are to be asked for before the first next()
  ImportedStream& stream() { return stream_; }
  const StampSurvey& survey() const { return survey_; }

  bool next();  // false at the end. Throws InputError of bad rows unless they are to be left out
  TimeNs stamp_ns() const { return stamp_ns_; }
  std::int64_t line() const { return rows_->line(); }

  // The current row, or one before it, is not used.
  void leave_out(RowFate fate, std::int64_t line);
  // Throws it again unless bad rows are to be left out.
  void bad(const InputError& error);
  // Throws where no row was written.
  void finish();

 private:
  const RowFate* fate();
  void pass_over();

  const StampSurvey& survey_;
  TimeNs shift_ns_;
  bool keep_going_, ended_ = false;
  ImportedStream& stream_;
  Warnings& warnings_;
  std::unique_ptr<RowSource> rows_;
  TimeReader time_;
  RowPlace place_;
  std::size_t next_left_out_ = 0;
  TimeNs stamp_ns_ = 0;
};

}  // namespace herr
