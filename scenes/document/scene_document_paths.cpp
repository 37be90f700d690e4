#include "scenes/document/scene_document_paths.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <utility>

#include "scenes/document/document_limits.h"
#include "scenes/document/scene_document_parts.h"
#include "scenes/model/placed_objects.h"
#include "scenes/model/transform_checks.h"

namespace herr {
namespace {

// A scale that changes its sign is 0 in between, where nothing can be traced.
void require_same_signs(const JsonObject& key, const glm::dvec3& before, const glm::dvec3& scale) {
  for (int axis = 0; axis < 3; ++axis) {
    if ((before[axis] < 0) == (scale[axis] < 0)) continue;
    key.fail("scale",
             std::string("passes through 0 on the ") + "xyz"[axis] + " axis on its way from the key before",
             "write scales of the same sign, or turn the object instead");
  }
}

// How far the corners of a box that is placed lie from the origin, at most.
double reach_m(const glm::dmat4x3& world_from_placed, const Bounds& box) {
  const glm::dvec3 middle = 0.5 * (box.lower + box.upper), half = 0.5 * (box.upper - box.lower);
  glm::dvec3 farthest = glm::abs(world_from_placed * glm::dvec4(middle, 1.0));
  for (int axis = 0; axis < 3; ++axis) farthest += glm::abs(world_from_placed[axis]) * half[axis];
  return glm::length(farthest);
}

}  // namespace

ObjectPath parse_path(const JsonObject& entry, const Placement& own) {
  ObjectPath path;
  if (!entry.has("path")) return path;
  const JsonObject object = entry.object("path");
  object.allow_only({"keys", "loop"});
  path.loop = object.boolean_or("loop", false);
  const std::vector<JsonObject> keys = object.objects("keys");
  if (keys.empty()) object.fail("keys", "has no key", "write where the object stands at some t_s");
  if (keys.size() > std::size_t{kMostPathKeys})
    object.fail("keys", "has more than " + std::to_string(kMostPathKeys) + " keys", "leave some out");
  path.keys.reserve(keys.size());
  for (const JsonObject& key : keys) {
    key.allow_only({"t_s", "translation", "rotation_xyzw", "scale"});
    const PathKey read{key.number("t_s", 0, kLatest_s), parse_placement_change(key).apply(own)};
    if (!path.keys.empty()) {
      if (!(read.time_s > path.keys.back().time_s))
        key.fail("t_s", "is not after that of the key before", "sort the keys by time, each at its own");
      require_same_signs(key, path.keys.back().placement.scale, read.placement.scale);
    }
    path.keys.push_back(read);
  }
  return path;
}

void check_path(const JsonObject& entry, const ObjectPath& path, const Scene& scene, const Instance& part) {
  if (path.empty()) return;
  const Bounds box = instance_bounds(scene, part);
  const bool has_extent = box.lower.x <= box.upper.x;  // not of a mesh without vertices
  for (std::size_t i = 0; i < path.keys.size(); ++i) {
    const glm::dmat4x3 world_from_placed = path.keys[i].placement.matrix();
    auto problem = transform_problem(compose(world_from_placed, part.world_from_object));
    if (!problem && has_extent && !(reach_m(world_from_placed, box) <= kFarthest_m))
      problem = "reaches farther than 1e12 m";
    if (!problem) continue;
    entry.object("path").objects("keys")[i].fail(nullptr, "places the object so that it " + *problem,
                                                 "write another scale or a nearer place");
  }
}

void put_on_path(const JsonObject& entry, Scene& scene) {
  PlacedObject& object = add_object_of(static_cast<std::uint32_t>(scene.instances.size() - 1), scene);
  object.path = parse_path(entry, object.placement);
  Instance& instance = scene.instances.back();
  instance.world_from_object = instance.placed_from_object;
  check_path(entry, object.path, scene, instance);
  instance.world_from_object = compose(object.start().matrix(), instance.placed_from_object);
}

}  // namespace herr
