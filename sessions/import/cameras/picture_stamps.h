// When each picture of a feed was taken: from a table, from the names of the files, or from EXIF. Given,
// never invented. Before: camera_pictures, a map's camera columns. After: `herr convert` writes
// cam<i>/data.csv.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sessions/format/pose.h"
#include "sessions/import/cameras/camera_pictures.h"
#include "sessions/import/map/column_map.h"

namespace herr {

struct StampedPicture {
  TimeNs stamp_ns = 0;  // of the recording's clock, not yet shifted
  std::filesystem::path file;
};

struct StampedPictures {
  std::vector<StampedPicture> pictures;  // by stamp, strictly growing; no file twice
  std::string source;                    // "the table frames.csv", "the names of the files", "EXIF"
  std::int64_t without_stamp = 0, repeated_stamps = 0, rows_without_picture = 0;  // left out
  // Whole sentences: one for each kind of left out.
  std::vector<std::string> assumed, remarks;
};

// Each throws InputError that says what was found and what is expected; also where no picture is left.

// Rows that columns.valid does not pass are of no concern here.
StampedPictures stamps_from_table(const CameraPictures& pictures, const std::filesystem::path& table,
                                  const CameraColumns& columns);
// `pattern`: of a file name without its extension: text with one of {s} {ms} {us} {ns} {date}
// {date:%Y%m%d_%H%M%S}, and {*} for any text: "frame_{ms}". Dates: text/date_text.h; without a zone of their
// own in `zone_minutes`, else UTC.
StampedPictures stamps_from_names(const CameraPictures& pictures, const std::string& pattern,
                                  std::optional<int> zone_minutes = {});
// DateTimeOriginal with SubSecTimeOriginal, and OffsetTimeOriginal or `zone_minutes`.
StampedPictures stamps_from_exif(const CameraPictures& pictures, std::optional<int> zone_minutes);

// A pattern for stamps_from_names where the names of all pictures are the same but for one growing number of
// 13 digits (ms), 16 (us), 19 (ns), or 10 with a fraction (s), time since 1970, and for other numbers beside
// it.
std::optional<std::string> stamp_pattern_of(const CameraPictures& pictures);

}  // namespace herr
