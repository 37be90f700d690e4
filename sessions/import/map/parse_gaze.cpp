// The gaze columns of a map.
#include <nlohmann/json.hpp>

#include "sessions/import/map/map_parts.h"

namespace herr {
namespace {

void parse_angles(const JsonObject& entry, const char* azimuth, const char* elevation,
                  DirectionColumns& ray) {
  ray.angles = ColumnGroup{{parse_ref(entry, azimuth), parse_ref(entry, elevation)}, 2};
  ray.radians_per_unit = parse_word(entry, "unit", kAngleUnitWords, "deg");
}

void parse_point(const JsonObject& entry, DirectionColumns& ray) {
  ray.point = parse_group(entry, "point", 3);
  ray.metres_per_unit = parse_word(entry, "unit", kLengthWords, "m");
  if (entry.has("origin")) ray.origin = parse_group(entry, "origin", 3);
}

DirectionColumns parse_ray(const JsonObject& entry) {
  DirectionColumns ray;
  const std::string kind = only_one_of(entry, {"vector", "tangents", "azimuth", "yaw", "point"}, "direction");
  if (kind != "azimuth") refuse_beside(entry, kind.c_str(), {"elevation", "convention"});
  if (kind != "yaw") refuse_beside(entry, kind.c_str(), {"pitch"});
  if (kind != "point") refuse_beside(entry, kind.c_str(), {"origin"});
  if (kind == "vector" || kind == "tangents") refuse_beside(entry, kind.c_str(), {"unit"});
  if (kind == "vector") ray.vector = parse_group(entry, "vector", 3);
  if (kind == "tangents") ray.tangents = parse_group(entry, "tangents", 2);
  if (kind == "yaw") parse_angles(entry, "yaw", "pitch", ray);
  if (kind == "azimuth") {
    parse_angles(entry, "azimuth", "elevation", ray);
    ray.angle_kind = parse_word(entry, "convention", kConventionWords);
  }
  if (kind == "point") parse_point(entry, ray);
  if (entry.has("placeholder")) ray.placeholder = entry.vec3("placeholder", -1e9, 1e9);
  if (entry.has("confidence")) ray.confidence = parse_ref(entry, "confidence");
  ray.valid = parse_filter(entry);
  return ray;
}

// One ray for both eyes, and where the file tells it, which pupils it was made from.
void parse_combined(const JsonObject& entry, GazeColumns& gaze) {
  entry.allow_only({"vector", "tangents", "azimuth", "elevation", "convention", "yaw", "pitch", "point",
                    "origin", "unit", "placeholder", "confidence", "valid", "valid_left", "valid_right"});
  gaze.rays = {parse_ray(entry)};
  if (entry.has("valid_left") != entry.has("valid_right"))
    entry.fail(nullptr, "has one of valid_left and valid_right", "give both or neither");
  if (entry.has("valid_left"))
    gaze.pupils = {parse_filter(entry, "valid_left"), parse_filter(entry, "valid_right")};
}

DirectionColumns parse_eye(const JsonObject& entry) {
  entry.allow_only({"vector", "tangents", "azimuth", "elevation", "convention", "yaw", "pitch", "point",
                    "origin", "unit", "placeholder", "confidence", "valid"});
  return parse_ray(entry);
}

}  // namespace

GazeColumns parse_gaze(const JsonObject& entry) {
  entry.allow_only({"separator", "decimal", "comment", "header", "header_lines", "names_line", "ragged",
                    "xml", "variant", "in_head_file", "time", "space", "axes", "combined", "left", "right"});
  GazeColumns gaze;
  gaze.variant = entry.text_or("variant", "");
  gaze.in_head_file = entry.boolean_or("in_head_file", false);
  gaze.table = parse_table(entry);
  gaze.time = parse_time(entry);
  gaze.space = parse_word(entry, "space", kSpaceWords, "head");
  gaze.axes = parse_axes(entry, "axes");
  if (entry.has("combined")) {
    refuse_beside(entry, "combined", {"left", "right"});
    parse_combined(entry.object("combined"), gaze);
    return gaze;
  }
  if (!entry.has("left") || !entry.has("right"))
    entry.fail(nullptr, "names no rays for both eyes", "give either combined, or left and right");
  gaze.rays = {parse_eye(entry.object("left")), parse_eye(entry.object("right"))};
  return gaze;
}

}  // namespace herr
