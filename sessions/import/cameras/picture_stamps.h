// When each picture of a feed was taken: from a table, from the names of the files, or from EXIF. Given, never
// invented. Before: camera_pictures, a map's camera columns. After: `herr convert` writes cam<i>/data.csv.
#pragma once

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
  std::vector<StampedPicture> pictures;  // by stamp, strictly growing
  std::string source;                    // "the table frames.csv", "the names of the files", "EXIF"
  std::int64_t without_stamp = 0, repeated_stamps = 0, rows_without_picture = 0;  // left out
  std::vector<std::string> remarks;      // whole sentences, one for each kind of left out
};

// Each throws InputError that says what was found and what is expected.
StampedPictures stamps_from_table(const CameraPictures& pictures, const std::filesystem::path& table,
                                  const CameraColumns& columns);
// `pattern`: of a file name without its extension: text with one of {s} {ms} {us} {ns} {date}, and {*} for any
// text: "frame_{ms}". {date}: as DateFormat of text/date_text.h reads it.
StampedPictures stamps_from_names(const CameraPictures& pictures, const std::string& pattern);
// DateTimeOriginal with SubSecTimeOriginal, and OffsetTimeOriginal or `zone_minutes`.
StampedPictures stamps_from_exif(const CameraPictures& pictures, std::optional<int> zone_minutes);

}  // namespace herr
