// Reads a foreign recording by a column map and yields rows in our units and axes, in order of time.
// Before: presets/choose_format. After: SessionRecorder (or whatever takes the rows).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>

#include "sessions/import/import_report.h"
#include "sessions/import/map/column_map.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

// Chosen alternatives of a map; must outlive the import.
struct ImportColumns {
  const HeadColumns* head = nullptr;  // null: no head was recorded
  const GazeColumns* gaze = nullptr;  // null: no gaze was recorded
};

// Parts that were not recorded and stand still instead, on the user's word.
struct StillParts {
  bool head = false;  // at the origin, level, at the gaze's stamps
  bool gaze = false;  // straight ahead, at the poses' stamps
};

struct ImportRequest {
  std::filesystem::path head_file;                 // empty with a still head
  std::optional<std::filesystem::path> gaze_file;  // none: in the head file where the map says so, else none
  ImportColumns columns;
  StillParts still;
  bool keep_going = false;     // leave bad rows out and count them instead of throwing
  std::size_t sort_rows = 0;   // rows that come at most so many rows late are put where they belong
  std::int64_t most_rows = 0;  // of each stream; 0: all (a trial reads a part)
  // Centres of the eyes in the head, for gaze at points that names no origin; combined gaze has the head's.
  std::array<glm::dvec3, 2> eyes{glm::dvec3(-0.0315, 0, 0), glm::dvec3(0.0315, 0, 0)};
};

struct ImportSink {
  std::function<void(const PoseRow&)> pose;
  std::function<void(const GazeRow&)> gaze;
};

// Poses first, then gaze. Negative stamps move all streams by the same whole number of seconds (shift_ns of
// the report; the feed's stamps move with them). Throws InputError; a stream without one good row is an error
// whatever the request.
ImportReport import_rows(const ImportRequest& request, const ImportSink& sink);

}  // namespace herr
