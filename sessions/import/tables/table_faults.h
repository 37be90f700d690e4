// What is likely the cause where a table does not fit its map, in words. Before: table_layout. After:
// delimited_table.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "sessions/import/map/column_map.h"
#include "sessions/import/tables/table_layout.h"
#include "sessions/import/tables/table_sample.h"

namespace herr {

// A column that the map asks for is not there, or is named twice. Throws InputError.
[[noreturn]] void fail_column(const TableSample& sample, const TableFormat& format, const TableLayout& layout,
                              std::span<const ColumnRef> wanted, const ColumnRef& column);

// There is no row. Throws InputError.
[[noreturn]] void fail_without_rows(const TableSample& sample, const TableLayout& layout);

struct FaultWords {
  std::string problem, remedy;
};

// A line with another number of fields. `needed`: fields up to the last column in use.
FaultWords wrong_field_count(std::string_view line, const TableLayout& layout, std::size_t found,
                             std::size_t needed, bool ragged);

// In the place of fields of "1,5,0,2" read as four: one row of a sample that is like that. Throws InputError
// then.
void refuse_commas_of_two_kinds(const TableSample& sample, const TableLayout& layout);

}  // namespace herr
