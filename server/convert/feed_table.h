// The table that says of a camera's pictures when they were taken, or through which lens: the one named, or
// the one that programs put beside a folder of pictures. Before: feed_sources. After: convert_feed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "server/convert/feed_sources.h"
#include "sessions/import/presets/camera_table.h"
#include "sessions/import/presets/fitting_columns.h"

namespace herr {

struct CameraTable {
  std::filesystem::path file;
  CameraTableColumns format;
  bool named = false;  // by the user or the recorder's layout, not only found beside the pictures
};

struct CameraTableSearch {
  const ColumnMap& map;  // of the recording
  // The recording's own files: no tables of stamps, unless the layout or the user names them as such.
  const RecordingFiles& files;
  bool stamps_needed = true;  // else it may have the lens
};

// A table that is not named, or not needed, and is no table of stamps is passed over: `passed_over` says why.
// Throws InputError about one that is named.
std::optional<CameraTable> find_camera_table(const FeedSource& source, const CameraTableSearch& search,
                                             std::vector<std::string>& passed_over);

}  // namespace herr
