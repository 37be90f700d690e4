// Whether a row counts, by the conditions of a map. Before: RowSource, RowFilter. After: head_reader,
// gaze_reader.
#pragma once

#include <cstddef>
#include <vector>

#include "sessions/import/map/column_map.h"
#include "sessions/import/tables/row_source.h"

namespace herr {

class FilterReader {
 public:
  FilterReader() = default;
  // `filter` must outlive the reader. Throws InputError.
  FilterReader(RowSource& rows, const RowFilter& filter);
  bool passes(const RowSource& rows) const;

 private:
  struct Test {
    const RowCondition* condition = nullptr;
    std::size_t place = 0;
    bool passes(const RowSource& rows) const;
  };
  std::vector<Test> all_, any_;
};

void add_columns(const RowFilter& filter, std::vector<ColumnRef>& columns);

}  // namespace herr
