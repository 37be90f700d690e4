// The stamp of a row, by the time columns of a map. Before: RowSource, TimeColumns. After: import_rows orders rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "sessions/import/map/column_map.h"
#include "sessions/import/tables/row_source.h"

namespace herr {

class TimeReader {
 public:
  // Looks the places up. Throws InputError.
  TimeReader(RowSource& rows, const TimeColumns& columns);
  // Of the current row, in nanoseconds since the zero of the file's clock (1970 for ticks, FILETIME and dates),
  // scaled and moved; may be negative. Within +-kLastStampNs. Throws InputError that quotes the field and names
  // the likely cause.
  TimeNs read(const RowSource& rows);

 private:
  const TimeColumns* columns_;
  std::size_t place_ = 0, nanoseconds_place_ = 0;
  std::int64_t row_ = 0;  // rate
};

// The columns that it asks for.
void add_columns(const TimeColumns& time, std::vector<ColumnRef>& columns);

}  // namespace herr
