// A table as words, for page and terminal alike. Before: study_tables. After: table_html, table_text.
#pragma once

#include <string>
#include <vector>

namespace herr {

struct ReportColumn {
  std::string name;
  bool words = false;      // to the left; else a number, to the right
  bool page_only = false;  // too much for a terminal; words may take several lines
};

struct ReportTable {
  std::string title;
  std::vector<ReportColumn> columns;
  std::vector<std::vector<std::string>> rows;  // a cell for each column, plain text
  std::string note;                            // a sentence below; mostly empty
};

// In a wrapper that scrolls sideways by itself. Without `caption` the title is only read out.
std::string table_html(const ReportTable& table, bool caption = true);

// Lines of at most `most_columns` characters: columns of words are cut to what numbers leave them.
std::string table_text(const ReportTable& table, int most_columns);

// One paragraph, broken between words; `indent` spaces before each line but the first. A word longer than a
// line is broken within.
std::string wrapped_text(const std::string& text, int most_columns, int indent = 0);

}  // namespace herr
