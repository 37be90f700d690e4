#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/import/cameras/picture_finder.h"
#include "sessions/import/cameras/picture_order.h"
#include "sessions/import/cameras/picture_stamps.h"
#include "sessions/import/rows/filter_reader.h"
#include "sessions/import/rows/time_reader.h"
#include "sessions/import/tables/row_source.h"
#include "sessions/import/text/date_text.h"
#include "sessions/text/plain_values.h"

namespace herr {
namespace {

constexpr std::int64_t kMostStampRows = 10'000'000;

struct StampRow {
  TimeNs stamp_ns = 0;
  std::optional<std::size_t> picture;  // none: not in the folder
};

struct StampTable {
  std::vector<StampRow> rows;
  std::string unknown;  // the first field that names no picture of the folder
  std::int64_t unknown_line = 0;
  bool zone_assumed = false;  // dates that name none, in a map that names none
};

StampTable read_stamp_table(const CameraPictures& pictures, const std::filesystem::path& table,
                            const CameraColumns& columns) {
  std::vector<ColumnRef> wanted;
  add_columns(columns.time, wanted);
  add_columns(columns.valid, wanted);
  if (columns.file) wanted.push_back(*columns.file);
  const std::unique_ptr<RowSource> rows = open_rows(table, columns.table, wanted);
  TimeReader time(*rows, columns.time);
  const FilterReader valid(*rows, columns.valid);
  const PictureFinder finder(pictures, table);
  const std::size_t file = columns.file ? rows->place(*columns.file) : 0;
  const bool dated = columns.time.kind != TimeColumns::Kind::rate;
  const std::size_t stamp = dated ? rows->place(columns.time.column) : 0;
  const bool zoneless = columns.time.kind == TimeColumns::Kind::date && !columns.time.zone_minutes;
  StampTable read;
  while (rows->next()) {
    if (!valid.passes(*rows)) continue;
    if (dated && columns.file && rows->absent(stamp)) continue;  // the picture has no stamp
    StampRow row{time.read(*rows), {}};
    if (columns.file) {
      row.picture = finder.find(rows->text(file), rows->line());
      if (!row.picture && read.unknown_line == 0) {
        read.unknown = rows->text(file);
        read.unknown_line = rows->line();
      }
    }
    read.zone_assumed |= zoneless && !date_names_zone(rows->text(stamp), columns.time.date_format);
    read.rows.push_back(row);
    if (static_cast<std::int64_t>(read.rows.size()) > kMostStampRows)
      rows->fail("is one of more than 10 million rows", "give the table of one camera");
  }
  return read;
}

// Without a file column, row k is picture k.
void pair_in_order(StampTable& read, const CameraPictures& pictures, const std::filesystem::path& table) {
  if (read.rows.size() != pictures.files.size())
    throw InputError(
        table, 0,
        "has " + std::to_string(read.rows.size()) + " rows, and " + printable(folder_of(pictures).string()) +
            " holds " + std::to_string(pictures.files.size()) + " pictures",
        "give the folder and the table of the same camera, or name the column of the file names in the "
        "map's camera ('file')");
  for (std::size_t i = 0; i < read.rows.size(); ++i) read.rows[i].picture = i;
}

void refuse_strange_table(const StampTable& read, const CameraPictures& pictures,
                          const std::filesystem::path& table) {
  const auto known =
      std::count_if(read.rows.begin(), read.rows.end(), [](const auto& r) { return r.picture; });
  if (known > 0) return;
  if (read.rows.empty())
    throw InputError(table, 0, "has no rows", "give a table with a row for each picture");
  throw InputError(table, read.unknown_line,
                   "names '" + printable(read.unknown) + "', and no row of the table names a picture of " +
                       printable(folder_of(pictures).string()) + " (its first is '" +
                       printable(pictures.files.front().filename().string()) + "')",
                   "give the folder and the table of the same camera");
}

void remark_unused_rows(const StampTable& read, std::int64_t repeated, StampedPictures& stamped,
                        const std::string& name) {
  const std::int64_t unknown = stamped.rows_without_picture - repeated;
  if (unknown > 0)
    stamped.remarks.push_back(std::to_string(unknown) + " of " + std::to_string(read.rows.size()) +
                              " rows of " + name +
                              " name no picture of the folder and are left out (the first is '" +
                              printable(read.unknown) + "', line " + std::to_string(read.unknown_line) + ")");
  if (repeated > 0)
    stamped.remarks.push_back(std::to_string(repeated) + " of " + std::to_string(read.rows.size()) +
                              " rows of " + name +
                              " name a picture that an earlier row names and are left out");
}

}  // namespace

StampedPictures stamps_from_table(const CameraPictures& pictures, const std::filesystem::path& table,
                                  const CameraColumns& columns) {
  StampTable read = read_stamp_table(pictures, table, columns);
  if (!columns.file) pair_in_order(read, pictures, table);
  refuse_strange_table(read, pictures, table);
  const std::string name = printable(table.filename().string());
  StampedPictures stamped;
  stamped.source = "the table " + name;
  std::vector<bool> taken(pictures.files.size());
  std::int64_t repeated = 0;
  for (const StampRow& row : read.rows) {
    if (row.picture && !taken[*row.picture]) {
      taken[*row.picture] = true;
      stamped.pictures.push_back({row.stamp_ns, pictures.files[*row.picture]});
      continue;
    }
    ++stamped.rows_without_picture;
    if (row.picture) ++repeated;
  }
  if (read.zone_assumed)
    stamped.assumed.push_back("the dates in " + name + " name no zone and are taken as UTC");
  if (columns.time.kind == TimeColumns::Kind::rate)
    stamped.assumed.push_back("stamps of pictures, which were not recorded: " +
                              plain_number_text(columns.time.rate_hz) + " a second, as the map says");
  if (!columns.file)
    stamped.assumed.push_back("row by row, " + name + " stamps the pictures in the order of their names");
  remark_unused_rows(read, repeated, stamped, name);
  put_in_order(stamped, pictures, "have no stamp in " + name);
  return stamped;
}

}  // namespace herr
