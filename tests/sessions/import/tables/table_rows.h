// Rows of small files that a test writes, as text. Before: open_rows. After: the tests of this folder.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/import/map/column_map.h"
#include "sessions/import/tables/row_source.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {

inline std::vector<ColumnRef> named(const std::vector<std::string>& names) {
  std::vector<ColumnRef> columns;
  for (const std::string& name : names) columns.push_back({name, 0});
  return columns;
}

inline std::vector<ColumnRef> numbered(const std::vector<std::size_t>& numbers) {
  std::vector<ColumnRef> columns;
  for (const std::size_t number : numbers) columns.push_back({"", number});
  return columns;
}

// What a file holds in the wanted columns: "1|2;3|4", fields with "|" between them, rows with ";".
struct TableText {
  std::string rows;
  std::vector<std::int64_t> lines;
  std::vector<std::string> faults;  // of rows
  RowSourceCounts counts;
  std::string cut_off;
  char decimal = '.';
};

// `numbers`: fields as values, "nan" for absent ones.
inline TableText read_table(const std::filesystem::path& file, const TableFormat& format,
                            const std::vector<ColumnRef>& wanted, bool numbers = false) {
  TableText result;
  const auto rows = open_rows(file, format, wanted);
  std::vector<std::size_t> places;
  for (const ColumnRef& column : wanted) places.push_back(rows->place(column));
  for (bool more = true; more;) {
    try {
      more = rows->next();
      if (!more) break;
      std::string row;
      for (const std::size_t place : places) {
        if (!numbers)
          row += rows->text(place);
        else
          row += rows->absent(place) ? "nan" : std::to_string(rows->number(place));
        row += "|";
      }
      row.pop_back();
      result.rows += (result.rows.empty() ? "" : ";") + row;
      result.lines.push_back(rows->line());
    } catch (const std::runtime_error& error) {
      result.faults.emplace_back(error.what());
    }
  }
  result.counts = rows->counts();
  result.cut_off = rows->cut_off();
  result.decimal = rows->decimal();
  return result;
}

}  // namespace herr::test
