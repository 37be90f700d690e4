// How a table is laid out: what separates its fields, which line names its columns, where its rows begin.
// Before: table_sample. After: delimited_table, table_faults.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sessions/import/map/column_map.h"
#include "sessions/import/tables/table_sample.h"

namespace herr {

struct TableLayout {
  char separator = ',', decimal = '.';
  std::int64_t header_line = 0;  // that names the columns; 0: there is none
  std::int64_t rows_after = 0;   // up to this line there are no rows
  std::int64_t word_lines = 0;   // lines of words passed over, the header line not counted
  std::string header_text;       // a later line that says the same is no row; empty: there is none
  std::vector<std::string> names;
  // What a line above the rows calls all columns, though the map does not ask: a header line that it does not
  // expect, or a comment.
  std::vector<std::string> told_names;
  std::int64_t told_line = 0;
  std::size_t columns = 0;      // without empty ones at the end
  std::size_t most_fields = 0;  // with them
  bool any_rows = false;
  bool decimal_open = false;  // both decimal signs fit the sampled rows as well

  // Counted from 0. By name: as it stands, or without the # or % before the first one. None: it is not there,
  // or named twice.
  std::optional<std::size_t> find(const ColumnRef& column) const;
  bool has_all(std::span<const ColumnRef> wanted) const;
};

// With this separator, whatever the format says; the decimal sign of the format or, where that is open, a
// point.
TableLayout lay_out(const TableSample& sample, const TableFormat& format, char separator);

// The format's separator and decimal sign or, where they are open, those with which all wanted columns are
// there and most of their fields are numbers. Between equals: ; then tab, comma and blanks. Semicolons and
// tabs stand within no number; a comma before blanks, because the fields of "1.0, 2.0" are separated by both.
TableLayout choose_layout(const TableSample& sample, const TableFormat& format,
                          std::span<const ColumnRef> wanted);

// No number, and at least one field that begins as names do.
bool is_line_of_words(std::span<const std::string_view> fields);

// The commas of such a line seem to stand for decimal signs too: no field has a point, and several begin with
// a zero as the decimals of 0,05 do, or only some follow a blank.
bool has_commas_of_two_kinds(std::string_view line);

}  // namespace herr
