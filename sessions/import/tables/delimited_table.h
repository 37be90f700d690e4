// Rows of a table of text: any separator, with or without header lines, comments, quotes, blank lines.
// Before: table_layout says how it is laid out, LineReader reads. After: rows/.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sessions/files/line_reader.h"
#include "sessions/import/tables/row_source.h"
#include "sessions/import/tables/table_layout.h"
#include "sessions/import/tables/table_sample.h"

namespace herr {

class DelimitedTable : public RowSource {
 public:
  // Throws InputError.
  DelimitedTable(const std::filesystem::path& file, const TableFormat& format,
                 std::span<const ColumnRef> wanted);

  bool has(const ColumnRef& column) const override { return layout_.find(column).has_value(); }
  std::size_t place(const ColumnRef& column) override;
  bool next() override;

 private:
  bool next_line();
  bool is_row_line();
  std::size_t cut(std::string_view line);
  std::size_t cut_quoted(std::string_view line);
  bool names_columns() const;
  void refuse_rows_of_another_header();
  void check_count(std::size_t found);
  [[noreturn]] void fail_count(std::size_t found);

  TableFormat format_;
  std::vector<ColumnRef> wanted_;
  TableSample sample_;  // until the first row
  TableLayout layout_;
  LineReader reader_;
  TextLine text_;
  std::int64_t header_again_line_ = -1, other_header_line_ = 0;
  std::size_t needed_ = 0;  // fields up to the last place that was asked for
};

}  // namespace herr
