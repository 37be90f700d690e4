// Rows that a test writes itself, in the place of those of a file.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sessions/import/tables/row_source.h"

namespace herr::test {

class FakeRows : public RowSource {
 public:
  // `names` and the fields of rows are separated by blanks; "_" stands for a blank, "-" alone for an empty
  // field.
  FakeRows(std::string_view names, const std::vector<std::string>& rows, char decimal = '.')
      : RowSource("log.csv", decimal) {
    names_ = cut(names);
    for (const std::string& row : rows) rows_.push_back(cut(row));
    line_ = 1;
  }

  bool has(const ColumnRef& column) const override { return place_of(column) < names_.size(); }
  std::size_t place(const ColumnRef& column) override {
    if (!has(column)) fail("the column '" + column.name + "' is missing", "name it");
    return place_of(column);
  }
  bool next() override {
    if (row_ == rows_.size()) return false;
    fields_.assign(rows_[row_].begin(), rows_[row_].end());
    ++row_;
    ++line_;
    return true;
  }

 private:
  static std::vector<std::string> cut(std::string_view text) {
    std::vector<std::string> fields(1);
    for (const char c : text)
      if (c == ' ')
        fields.emplace_back();
      else
        fields.back() += c == '_' ? ' ' : c;
    for (std::string& field : fields)
      if (field == "-") field.clear();
    return fields;
  }
  std::size_t place_of(const ColumnRef& column) const {
    if (column.number > 0) return column.number - 1;
    std::size_t place = 0;
    while (place < names_.size() && names_[place] != column.name) ++place;
    return place;
  }

  std::vector<std::vector<std::string>> rows_;
  std::size_t row_ = 0;
};

// "x y z": one column each.
inline ColumnGroup group_of(std::string_view names) {
  ColumnGroup group;
  group.columns.emplace_back();
  for (const char c : names)
    if (c == ' ')
      group.columns.emplace_back();
    else
      group.columns.back().name += c;
  group.numbers = group.columns.size();
  return group;
}

}  // namespace herr::test
