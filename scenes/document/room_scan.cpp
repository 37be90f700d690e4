#include "scenes/document/room_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "scenes/document/catcher_meshes.h"
#include "scenes/model/transform_checks.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

constexpr double kFarthestInRoom_m = 1e9;  // of a place in a room
constexpr double kSameTopShare = 0.05;     // of the box: between its top and the plane that was seen of it
constexpr double kThinnestShare = 1e-6;    // of a part: less has no area to catch light with
constexpr double kUnitLength = 1e-3;       // tolerance of a quaternion's length

// One labelled part: a plane in x and z (lower.y = upper.y = 0), or a box.
struct ScanPart {
  std::string label;
  glm::dmat4x3 scan_from_part{1.0};
  bool plane = false;
  glm::dvec3 lower{0.0}, upper{0.0};
};

bool only_hangs(const std::string& label) {
  constexpr std::array kHanging{"WALL_ART", "WINDOW_FRAME", "DOOR_FRAME", "INVISIBLE_WALL_FACE", "OPENING"};
  return std::find(kHanging.begin(), kHanging.end(), label) != kHanging.end();
}

glm::dvec3 components(const JsonObject& object) {
  return {object.number("x", -kFarthestInRoom_m, kFarthestInRoom_m),
          object.number("y", -kFarthestInRoom_m, kFarthestInRoom_m),
          object.number("z", -kFarthestInRoom_m, kFarthestInRoom_m)};
}

glm::dmat4x3 parse_location(const JsonObject& part) {
  const JsonObject located = part.object("locatable_META"), turn = located.object("orientation");
  const auto q = [&](const char* key) { return turn.number(key, -1 - kUnitLength, 1 + kUnitLength); };
  const glm::dquat orientation(q("w"), q("x"), q("y"), q("z"));
  if (std::abs(glm::length(orientation) - 1.0) > kUnitLength) {
    located.fail("orientation", "is not of unit length", "write a unit quaternion");
  }
  const glm::dmat3 rotation = glm::mat3_cast(glm::normalize(orientation));
  return {rotation[0], rotation[1], rotation[2], components(located.object("position"))};
}

double longest_of(const glm::dvec3& sizes) {
  return std::max({sizes.x, sizes.y, sizes.z});
}

// `axes`: where width, height and depth lie.
void parse_extent(const JsonObject& bounds, const std::vector<int>& axes, ScanPart& part) {
  constexpr std::array kOffsets{"x", "y", "z"}, kExtents{"width", "height", "depth"};
  const JsonObject offset = bounds.object("offset"), extent = bounds.object("extent");
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double size = extent.number(kExtents[i], 0, kFarthestInRoom_m);
    part.lower[axes[i]] = offset.number(kOffsets[i], -kFarthestInRoom_m, kFarthestInRoom_m);
    part.upper[axes[i]] = part.lower[axes[i]] + size;
  }
  const glm::dvec3 sizes = part.upper - part.lower;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (sizes[axes[i]] > kThinnestShare * longest_of(sizes)) continue;
    extent.fail(kExtents[i], "leaves no area to catch light with", "take the part out of the scan");
  }
}

std::vector<ScanPart> parse_parts(const JsonObject& root) {
  const std::vector<JsonObject> entities = root.objects("spatialEntities");
  if (entities.size() > kMostScanParts) {
    root.fail("spatialEntities", "has more than " + std::to_string(kMostScanParts) + " parts",
              "leave some out");
  }
  std::vector<ScanPart> parts;
  for (const JsonObject& entity : entities) {
    ScanPart part;
    part.label = entity.text("semanticLabel_META");
    part.plane = entity.has("bounded2D_META");
    if (only_hangs(part.label) || (!part.plane && !entity.has("bounded3D_META"))) continue;
    part.scan_from_part = parse_location(entity);
    if (part.plane) {
      parse_extent(entity.object("bounded2D_META"), {0, 2}, part);
    } else {
      parse_extent(entity.object("bounded3D_META"), {0, 1, 2}, part);
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

// A plane that was seen as the top of a box: both start at the same place.
bool is_top_of_a_box(const ScanPart& plane, const std::vector<ScanPart>& parts) {
  return std::any_of(parts.begin(), parts.end(), [&](const ScanPart& box) {
    return !box.plane && box.label == plane.label &&
           glm::distance(box.scan_from_part[3], plane.scan_from_part[3]) <=
               kSameTopShare * longest_of(box.upper - box.lower);
  });
}

PlacedCatcher mesh_of(const ScanPart& part) {
  if (!part.plane) return box_catcher(part.lower, part.upper);
  const glm::dvec3 &a = part.lower, &b = part.upper;
  return quad_catcher({glm::dvec3{a.x, 0, a.z}, {b.x, 0, a.z}, {b.x, 0, b.z}, {a.x, 0, b.z}});
}

}  // namespace

void append_room_scan(const std::filesystem::path& file, const glm::dmat4x3& world_from_scan,
                      const Material& material, Scene& scene) {
  const JsonDocument document(file);
  const JsonObject root = document.root();
  if (root.text("type") != "scene") root.fail("type", "is not \"scene\"", "name a room scan");
  root.integer("version", 1, 1);
  const std::vector<ScanPart> parts = parse_parts(root);
  scene.files.push_back(file);
  const auto material_index = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back(material);
  std::size_t shown = 0;
  for (const ScanPart& part : parts) {
    if (part.plane && is_top_of_a_box(part, parts)) continue;
    PlacedCatcher catcher = mesh_of(part);
    Instance instance;
    instance.name = catcher.mesh.name = material.name + "/" + printable(part.label);
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    instance.material = material_index;
    instance.catcher = true;
    glm::dmat4x3 part_from_mesh{1.0};
    part_from_mesh[3] = catcher.centre;
    instance.world_from_object = compose(world_from_scan, compose(part.scan_from_part, part_from_mesh));
    if (const auto problem = transform_problem(instance.world_from_object)) {
      root.fail("spatialEntities", "as the scene places it " + *problem, "place it elsewhere");
    }
    scene.meshes.push_back(std::move(catcher.mesh));
    scene.instances.push_back(std::move(instance));
    ++shown;
  }
  if (shown == 0) {
    scene.warnings.push_back(printable(file.string()) + ": the room scan has no plane or box to catch light");
  }
}

}  // namespace herr
