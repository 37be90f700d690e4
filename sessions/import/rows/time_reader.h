// The stamp of a row, by the time columns of a map. Before: RowSource, TimeColumns. After: import_rows orders
// rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sessions/format/pose.h"
#include "sessions/import/map/column_map.h"
#include "sessions/import/tables/row_source.h"

namespace herr {

class TimeReader {
 public:
  // Looks the places up; `columns` must outlive the reader. Throws InputError.
  TimeReader(RowSource& rows, const TimeColumns& columns);
  // Of the current row, in nanoseconds since the zero of the file's clock (1970 for ticks, FILETIME and
  // dates), scaled and moved; may be negative. Within +-kLastStampNs. Throws InputError that quotes the field
  // and names the likely cause. To be called once for each row, in their order: with a rate, rows are
  // counted, and a time of day that falls by about a day is the next day's.
  TimeNs read(const RowSource& rows);
  // A row that is there and cannot be cut into fields: it has its time where rows are counted.
  void pass_over() { ++row_; }
  // What is added to stamps by now because they name no day (no hour) and started again.
  TimeNs carried_ns() const { return carried_ns_; }

 private:
  TimeNs recorded(const RowSource& rows) const;
  TimeNs carried(TimeNs recorded_ns);
  TimeNs moved(const RowSource& rows, TimeNs recorded_ns) const;

  const TimeColumns* columns_;
  std::size_t place_ = 0, nanoseconds_place_ = 0;
  std::int64_t row_ = 0;
  TimeNs period_ns_ = 0, carried_ns_ = 0;
  std::optional<TimeNs> before_ns_;
};

// After how long its stamps start again; 0: never.
TimeNs period_of(const TimeColumns& time);

// The columns that it asks for.
void add_columns(const TimeColumns& time, std::vector<ColumnRef>& columns);

}  // namespace herr
