// Reads foreign tables by a column map and yields rows in our units and axes, in order of time.
// Before: ColumnMap. After: SessionRecorder (or whatever takes the rows).
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "sessions/import/column_map.h"
#include "sessions/import/import_report.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

struct ImportRequest {
  std::filesystem::path head_file;
  std::optional<std::filesystem::path> gaze_file;  // none: in the head file where the map says so, else none
  const ColumnMap* map = nullptr;                  // must outlive the call
  bool keep_going = false;                         // leave bad rows out and count them instead of throwing
};

struct ImportSink {
  std::function<void(const PoseRow&)> pose;
  std::function<void(const GazeRow&)> gaze;
};

// Poses first, then gaze. Throws InputError; a stream without one good row is an error whatever the request.
ImportReport import_rows(const ImportRequest& request, const ImportSink& sink);

// The fixed place of the head in the body that the head file records, by the alternative that fits the file.
const HeadColumns& fitting_head_columns(const ImportRequest& request);

}  // namespace herr
