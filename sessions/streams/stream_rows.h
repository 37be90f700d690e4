// The rows of a session's streams: what one line of each CSV file says, checked and normalised.
// Before: CsvRows. After: row_stream.h, which checks their order.
#pragma once

#include <array>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>

#include "sessions/format/pose.h"
#include "sessions/streams/csv_rows.h"

namespace herr {

struct PoseRow {
  TimeNs stamp_ns = 0;
  Pose world_from_head;
};

struct GazeRow {
  TimeNs stamp_ns = 0;
  std::array<glm::dvec3, 2> head_direction{};  // unit where valid
  // The tracker says so, and the direction is at most kMaxGazeAngleDeg off axis.
  std::array<bool, 2> valid{};
};

struct CameraRow {
  TimeNs stamp_ns = 0;
  std::string filename;  // as recorded: relative to the camera's data folder, not yet checked against it
};

// Eyes turn no further than about 55 degrees; a gaze beyond 60 is a tracker that lost the pupil.
inline constexpr double kMaxGazeAngleDeg = 60;

const CsvLayout& pose_layout();
const CsvLayout& gaze_layout();
const CsvLayout& camera_layout();

// The current row of `rows`. Throw InputError.
PoseRow parse_pose_row(const CsvRows& rows);
GazeRow parse_gaze_row(const CsvRows& rows);
CameraRow parse_camera_row(const CsvRows& rows);

}  // namespace herr
