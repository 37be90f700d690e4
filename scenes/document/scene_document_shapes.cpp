#include "scenes/document/scene_document_shapes.h"

#include <glm/mat3x3.hpp>
#include <string>
#include <utility>

#include "scenes/document/document_limits.h"
#include "scenes/document/scene_document_parts.h"
#include "scenes/document/scene_document_paths.h"
#include "scenes/model/transform_checks.h"

namespace herr {
namespace {

void require_thickness(const JsonObject& object, const char* key, const glm::dvec3& half) {
  for (int axis = 0; axis < 3; ++axis) {
    if (half[axis] >= kMinAxisScale) continue;
    object.fail(key, std::string("leaves no thickness on the ") + "xyz"[axis] + " axis",
                "write a larger number, or a catcher or mesh for a flat surface");
  }
}

glm::dmat4x3 placed(const glm::dvec3& half, const glm::dquat& orientation, const glm::dvec3& centre) {
  const glm::dmat3 rotation = glm::mat3_cast(orientation);
  return {rotation[0] * half.x, rotation[1] * half.y, rotation[2] * half.z, centre};
}

glm::dmat4x3 parse_sphere(const JsonObject& sphere) {
  sphere.allow_only({"centre", "radius", "radii", "rotation_xyzw"});
  if (sphere.has("radius") == sphere.has("radii")) {
    sphere.fail(nullptr, "needs a radius or three radii, and only one of them",
                "write \"radius\" or \"radii\"");
  }
  const glm::dvec3 centre = sphere.vec3("centre", -kFarthestPlace_m, kFarthestPlace_m);
  const char* key = sphere.has("radius") ? "radius" : "radii";
  const glm::dvec3 radii = sphere.has("radius") ? glm::dvec3(sphere.number("radius", 0, kLargest_m))
                                                : sphere.vec3("radii", 0, kLargest_m);
  require_thickness(sphere, key, radii);
  return placed(radii, parse_orientation(sphere, "rotation_xyzw"), centre);
}

glm::dmat4x3 parse_box_shape(const JsonObject& box) {
  box.allow_only({"min", "max", "centre", "half_extents", "rotation_xyzw"});
  const bool by_corners = box.has("min") || box.has("max");
  if (by_corners && (box.has("centre") || box.has("half_extents") || box.has("rotation_xyzw"))) {
    box.fail(nullptr, "is given both by corners and by its centre",
             "write min and max, or centre, half_extents and rotation_xyzw");
  }
  if (!by_corners) {
    const glm::dvec3 centre = box.vec3("centre", -kFarthestPlace_m, kFarthestPlace_m);
    const glm::dvec3 half = box.vec3("half_extents", 0, kLargest_m);
    require_thickness(box, "half_extents", half);
    return placed(half, parse_orientation(box, "rotation_xyzw"), centre);
  }
  const glm::dvec3 lower = box.vec3("min", -kFarthestPlace_m, kFarthestPlace_m);
  const glm::dvec3 upper = box.vec3("max", -kFarthestPlace_m, kFarthestPlace_m);
  for (int axis = 0; axis < 3; ++axis) {
    if (upper[axis] < lower[axis]) box.fail("max", "is below min on an axis", "swap the two numbers");
  }
  const glm::dvec3 half = 0.5 * (upper - lower);
  require_thickness(box, "max", half);
  return placed(half, {1, 0, 0, 0}, 0.5 * (lower + upper));
}

}  // namespace

void append_shape(const JsonObject& entry, Scene& scene) {
  entry.allow_only({"name", "sphere", "box", "material", "catcher", "present", "path"});
  if (entry.has("sphere") == entry.has("box")) {
    entry.fail(nullptr, "needs a sphere or a box, and only one of them", "write \"sphere\" or \"box\"");
  }
  Instance instance;
  instance.name = entry.text_or("name", entry.where());
  instance.kind = entry.has("sphere") ? ShapeKind::sphere : ShapeKind::box;
  instance.world_from_object = instance.kind == ShapeKind::sphere ? parse_sphere(entry.object("sphere"))
                                                                  : parse_box_shape(entry.object("box"));
  if (const auto problem = transform_problem(instance.world_from_object)) {
    entry.fail(nullptr, *problem, "write a larger size");
  }
  instance.catcher = entry.boolean_or("catcher", false);
  instance.present = entry.boolean_or("present", true);
  Material material;
  if (entry.has("material")) material = parse_material_override(entry.object("material")).apply(material);
  material.name = instance.name;
  instance.material = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back(std::move(material));
  scene.instances.push_back(std::move(instance));
  if (entry.has("path")) put_on_path(entry, scene);
}

}  // namespace herr
