// The first lines of a table, from which its layout is found. Before: LineReader. After: table_layout.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sessions/import/map/column_map.h"

namespace herr {

// Loggers add whatever the application has: 860 columns and 9 kB a row are a real example.
constexpr std::size_t kMostLineBytes = 64 << 10;

struct SampleLine {
  std::string text;
  std::int64_t number = 0;
  bool comment = false;  // `text` without its mark
};

struct TableSample {
  std::filesystem::path path;
  std::vector<SampleLine> lines;  // no blank ones; of comments in a row only the last, below the header lines
  bool whole_file = false;        // there are no more rows
  std::int64_t cut_off_line = 0;  // the file ends within this line
};

constexpr std::size_t kSampleLines = 64, kLongSampleLines = 4096;

// Up to so many lines with text below the header lines. Throws InputError: what cannot be a table at all.
TableSample read_table_sample(const std::filesystem::path& file, const TableFormat& format,
                              std::size_t lines);

}  // namespace herr
