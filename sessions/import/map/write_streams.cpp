// The head's and the gaze's columns as JSON.
#include "sessions/import/map/map_words.h"
#include "sessions/import/map/write_parts.h"

namespace herr {
namespace {

MapJson orientation_json(const HeadColumns& head) {
  MapJson entry;
  const RotationKind kind = head.rotation_kind;
  const char* key = word_of(kRotationWords, kind);
  entry[key] = kind == RotationKind::fixed ? MapJson(true) : json_of(head.rotation);
  if (kind == RotationKind::euler_xyz || kind == RotationKind::rotation_vector)
    entry["unit"] = word_of(kAngleUnitWords, head.radians_per_unit);
  if (holds_position(kind)) entry["unit"] = word_of(kLengthWords, head.metres_per_unit);
  if (kind == RotationKind::euler_xyz) {
    entry["order"] = head.euler_order;
    if (head.euler_sense != std::array<int, 3>{1, 1, 1}) entry["sense"] = head.euler_sense;
  }
  if (is_matrix(kind)) entry["major"] = word_of(kMajorWords, head.column_major);
  if (kind == RotationKind::forward_up) entry["up"] = json_of(head.up);
  if (head.head_from_world) entry["inverse"] = true;
  return entry;
}

void write_ray(const DirectionColumns& ray, MapJson& entry) {
  if (ray.vector) entry["vector"] = json_of(*ray.vector);
  if (ray.tangents) entry["tangents"] = json_of(*ray.tangents);
  if (ray.angles) {
    const bool tangents = ray.angle_kind == AngleKind::tangents;
    entry[tangents ? "yaw" : "azimuth"] = json_of(ray.angles->columns.at(0));
    entry[tangents ? "pitch" : "elevation"] = json_of(ray.angles->columns.at(1));
    entry["unit"] = word_of(kAngleUnitWords, ray.radians_per_unit);
    if (!tangents) entry["convention"] = word_of(kConventionWords, ray.angle_kind);
  }
  if (ray.point) {
    entry["point"] = json_of(*ray.point);
    entry["unit"] = word_of(kLengthWords, ray.metres_per_unit);
    if (ray.origin) entry["origin"] = json_of(*ray.origin);
  }
  if (ray.placeholder) entry["placeholder"] = {ray.placeholder->x, ray.placeholder->y, ray.placeholder->z};
  if (ray.confidence) entry["confidence"] = json_of(*ray.confidence);
  write_filter(ray.valid, "valid", entry);
}

MapJson combined_json(const GazeColumns& gaze) {
  MapJson entry;
  write_ray(gaze.rays.at(0), entry);
  if (gaze.pupils.size() == 2) {
    entry["valid_left"] = json_of(gaze.pupils[0]);
    entry["valid_right"] = json_of(gaze.pupils[1]);
  }
  return entry;
}

}  // namespace

MapJson json_of(const HeadColumns& head) {
  MapJson entry;
  if (!head.variant.empty()) entry["variant"] = head.variant;
  write_table(head.table, entry);
  entry["time"] = json_of(head.time);
  if (head.position) {
    entry["position"]["columns"] = json_of(*head.position);
    entry["position"]["unit"] = word_of(kLengthWords, head.metres_per_unit);
  }
  entry["orientation"] = orientation_json(head);
  entry["world_axes"] = json_of(head.world_axes);
  entry["head_axes"] = json_of(head.head_axes);
  entry["handedness"] = word_of(kHandWords, head.world_axes.left_handed());
  if (const Pose& body = head.body_from_head; body != Pose{}) {
    entry["body_from_head"]["position"] = {body.position.x, body.position.y, body.position.z};
    const glm::dquat& q = body.orientation;
    entry["body_from_head"]["orientation_xyzw"] = {q.x, q.y, q.z, q.w};
  }
  if (head.gravity) entry["gravity"] = json_of(*head.gravity);
  if (head.part) entry["part"] = json_of(*head.part);
  write_filter(head.valid, "valid", entry);
  return entry;
}

MapJson json_of(const GazeColumns& gaze) {
  MapJson entry;
  if (!gaze.variant.empty()) entry["variant"] = gaze.variant;
  if (gaze.in_head_file) entry["in_head_file"] = true;
  write_table(gaze.table, entry);
  entry["time"] = json_of(gaze.time);
  if (gaze.space != GazeSpace::head) entry["space"] = word_of(kSpaceWords, gaze.space);
  entry["axes"] = json_of(gaze.axes);
  if (gaze.rays.size() == 1) {
    entry["combined"] = combined_json(gaze);
  } else {
    write_ray(gaze.rays.at(0), entry["left"]);
    write_ray(gaze.rays.at(1), entry["right"]);
  }
  return entry;
}

}  // namespace herr
