#include "sessions/streams/stream_rows.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace herr {
namespace {

constexpr double kMaxPositionM = 1e9;  // a thousand times around the world: beyond it the units are wrong
// What rounding to three or more decimals in a file can do to a unit vector, and no more.
constexpr double kQuaternionSlack = 1e-3;
constexpr double kGazeSlack = 1e-2;

}  // namespace

const CsvLayout& pose_layout() {
  static const CsvLayout layout{{"timestamp_ns", "px", "py", "pz", "qx", "qy", "qz", "qw"}, false};
  return layout;
}

const CsvLayout& gaze_layout() {
  static const CsvLayout layout{{"timestamp_ns", "lx", "ly", "lz", "l_valid", "rx", "ry", "rz", "r_valid"},
                                true};
  return layout;
}

const CsvLayout& camera_layout() {
  static const CsvLayout layout{{"timestamp_ns", "filename"}, false};
  return layout;
}

PoseRow parse_pose_row(const CsvRows& rows) {
  PoseRow row;
  row.stamp_ns = rows.stamp(0);
  row.world_from_head.position = {rows.number(1), rows.number(2), rows.number(3)};
  // hypot does not overflow for components near the largest double.
  if (!(std::hypot(row.world_from_head.position.x, row.world_from_head.position.y,
                   row.world_from_head.position.z) < kMaxPositionM))
    rows.fail("the position is 1e9 m or more from the origin", "positions are in metres");
  const double x = rows.number(4), y = rows.number(5), z = rows.number(6), w = rows.number(7);
  const double norm = std::hypot(std::hypot(x, y), std::hypot(z, w));
  if (norm == 0)
    rows.fail("the orientation is the zero quaternion", "mark lost tracking by leaving the row out");
  if (!(std::abs(norm - 1) <= kQuaternionSlack))
    rows.fail("the orientation is not a unit quaternion", "write qx,qy,qz,qw with a norm of 1 within 0.001");
  row.world_from_head.orientation = glm::dquat(w / norm, x / norm, y / norm, z / norm);
  return row;
}

GazeRow parse_gaze_row(const CsvRows& rows) {
  GazeRow row;
  row.stamp_ns = rows.stamp(0);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const std::size_t first = 1 + 4 * eye;
    const double x = rows.number(first), y = rows.number(first + 1), z = rows.number(first + 2);
    if (!rows.flag(first + 3)) continue;  // whatever the tracker wrote for a closed eye is no direction
    const std::string side = eye == 0 ? "left" : "right";
    const double norm = std::hypot(x, y, z);
    if (norm == 0) rows.fail("the " + side + " gaze is the zero vector", "set its valid flag to 0");
    if (!(std::abs(norm - 1) <= kGazeSlack))
      rows.fail("the " + side + " gaze is not a unit vector",
                "write a direction with a norm of 1 within 0.01");
    row.head_direction[eye] = glm::dvec3(x, y, z) / norm;
    const double off_axis = std::atan2(std::hypot(x, y), -z);
    row.valid[eye] = off_axis <= glm::radians(kMaxGazeAngleDeg);
  }
  return row;
}

CameraRow parse_camera_row(const CsvRows& rows) {
  CameraRow row{rows.stamp(0), std::string(rows.text(1))};
  if (row.filename.empty()) rows.fail("the filename is empty", "name an image in the camera's data folder");
  return row;
}

}  // namespace herr
