#include "scenes/document/scene_document_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

#include "scenes/document/catcher_meshes.h"
#include "scenes/document/document_limits.h"
#include "scenes/document/scene_document_paths.h"
#include "scenes/model/transform_checks.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr double kLargestRefractiveIndex = 100;  // glTF sets no limit; diamond has 2.4

glm::dvec3 parse_scale(const JsonObject& entry) {
  if (!entry.has("scale")) return glm::dvec3(1.0);
  glm::dvec3 scale(0.0);
  if (entry.is_number("scale")) {
    scale = glm::dvec3(entry.number("scale", -kLargest_m, kLargest_m));
  } else {
    scale = entry.vec3("scale", -kLargest_m, kLargest_m);
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(scale[axis]) < kMinAxisScale) {
      entry.fail("scale", "is 0: the object would have no extent", "write a scale other than 0");
    }
  }
  return scale;
}

std::optional<float> optional_factor(const JsonObject& object, const char* key) {
  if (!object.has(key)) return std::nullopt;
  return static_cast<float>(object.number(key, 0, 1));
}

PlacedCatcher parse_box_catcher(const JsonObject& box) {
  box.allow_only({"min", "max"});
  const glm::dvec3 lower = box.vec3("min", -kFarthestPlace_m, kFarthestPlace_m);
  const glm::dvec3 upper = box.vec3("max", -kFarthestPlace_m, kFarthestPlace_m);
  int flat_axes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (upper[axis] < lower[axis]) box.fail("max", "is below min on an axis", "swap the two numbers");
    // As the mesh will have it: an extent that vanishes in float has no area either.
    if (static_cast<float>(upper[axis] - lower[axis]) == 0) ++flat_axes;
  }
  if (flat_axes > 1) box.fail("max", "equals min on more than one axis", "give the box an area");
  return box_catcher(lower, upper);
}

PlacedCatcher parse_quad(const JsonObject& object) {
  const nlohmann::json& list = object.value("quad");
  if (!list.is_array() || list.size() != 4) {
    object.fail("quad", "is not an array of four corners", "write [[x, y, z], ...] counter-clockwise");
  }
  std::array<glm::dvec3, 4> corners{};
  for (std::size_t i = 0; i < 4; ++i) {
    const nlohmann::json corner = {{"corner", list[i]}};
    const JsonObject view(corner, object.file(), object.where() + ".quad[" + std::to_string(i) + "]");
    corners[i] = view.vec3("corner", -kFarthestPlace_m, kFarthestPlace_m);
  }
  if (const auto problem = quad_problem(corners)) {
    object.fail("quad", *problem, "write the four corners of a flat convex surface counter-clockwise");
  }
  return quad_catcher(corners);
}

// The kind of a light, and that it has no field of another kind.
LightKind parse_light_kind(const JsonObject& object) {
  const std::string name = object.text_or("kind", "box");
  const LightKind kind = name == "spot" ? LightKind::spot : name == "sun" ? LightKind::sun : LightKind::box;
  if (kind == LightKind::box && name != "box") {
    object.fail("kind", "is \"" + printable(name) + "\"", "write box, spot or sun");
  }
  const auto refuse = [&](std::initializer_list<const char*> fields) {
    for (const char* field : fields) {
      if (object.has(field)) object.fail(field, "means nothing for a light of kind " + name, "remove it");
    }
  };
  if (kind == LightKind::box) refuse({"irradiance_w_m2", "direction", "inner_cone_deg", "outer_cone_deg"});
  if (kind == LightKind::spot) refuse({"irradiance_w_m2", "size"});
  if (kind == LightKind::sun) {
    refuse({"centre", "size", "intensity_w_sr", "inner_cone_deg", "outer_cone_deg", "range_m", "path"});
  }
  return kind;
}

glm::dvec3 parse_direction(const JsonObject& object) {
  const glm::dvec3 direction = object.vec3("direction", -kFarthestPlace_m, kFarthestPlace_m);
  const double length = glm::length(direction);
  if (!(length > 1e-9)) object.fail("direction", "is 0", "write the vector along which the light shines");
  return direction / length;
}

}  // namespace

glm::dquat parse_orientation(const JsonObject& object, const char* key) {
  if (!object.has(key)) return {1.0, 0.0, 0.0, 0.0};
  const std::array<double, 4> q = object.unit_quaternion(key);
  return glm::normalize(glm::dquat(q[3], q[0], q[1], q[2]));
}

Pose parse_pose(const JsonObject& object) {
  object.allow_only({"position", "orientation_xyzw"});
  return {object.vec3_or("position", -kFarthestPlace_m, kFarthestPlace_m, glm::dvec3(0.0)),
          parse_orientation(object, "orientation_xyzw")};
}

PlacementChange parse_placement_change(const JsonObject& entry) {
  PlacementChange change;
  if (entry.has("translation"))
    change.translation = entry.vec3("translation", -kFarthestPlace_m, kFarthestPlace_m);
  if (entry.has("rotation_xyzw")) change.rotation = parse_orientation(entry, "rotation_xyzw");
  if (entry.has("scale")) change.scale = parse_scale(entry);
  return change;
}

glm::dmat4x3 parse_placement(const JsonObject& entry) {
  return parse_placement_change(entry).apply({}).matrix();
}

MaterialOverride parse_material_override(const JsonObject& object) {
  object.allow_only(
      {"base_colour", "metallic", "roughness", "mirror", "emission", "transmission", "refractive_index"});
  MaterialOverride change;
  if (object.has("base_colour")) change.base_colour = glm::vec3(object.vec3("base_colour", 0, 1));
  if (object.has("emission")) change.emission = glm::vec3(object.vec3("emission", 0, kBrightest));
  change.metallic = optional_factor(object, "metallic");
  change.roughness = optional_factor(object, "roughness");
  change.mirror = optional_factor(object, "mirror");
  change.transmission = optional_factor(object, "transmission");
  if (object.has("refractive_index")) {
    change.refractive_index =
        static_cast<float>(object.number("refractive_index", 1, kLargestRefractiveIndex));
  }
  return change;
}

Material MaterialOverride::apply(Material material) const {
  // The number that the document gives is what is drawn: a texture must not multiply it.
  if (base_colour) {
    material.base_colour = *base_colour;
    material.base_colour_texture = -1;
  }
  if (metallic || roughness) {
    material.metallic = metallic.value_or(material.metallic);
    material.roughness = roughness.value_or(material.roughness);
    material.metallic_roughness_texture = -1;
  }
  if (transmission) {
    material.transmission = *transmission;
    material.transmission_texture = {};
  }
  if (refractive_index) material.refractive_index = *refractive_index;
  if (emission) {
    material.emission = *emission;
    material.emission_texture = {};
    // What an unlit surface shows is its emission: now this one.
    if (material.unlit) {
      material.unlit = false;
      if (!base_colour) material.base_colour = glm::vec3(0.0f);
      material.specular = 0.0f;
    }
  }
  if (mirror) material.mirror = *mirror;
  return material;
}

Material parse_catcher_material(const JsonObject& object, const std::string& name) {
  Material material;
  material.name = name;
  material.base_colour = glm::vec3(object.vec3_or("base_colour", 0, 1, glm::dvec3(0.5)));
  material.metallic = static_cast<float>(object.number_or("metallic", 0, 1, 0));
  material.roughness = static_cast<float>(object.number_or("roughness", 0, 1, 0.8));
  material.mirror = static_cast<float>(object.number_or("mirror", 0, 1, 0));
  return material;
}

void append_catcher(const JsonObject& object, Scene& scene) {
  object.allow_only(
      {"name", "box", "quad", "base_colour", "metallic", "roughness", "mirror", "present", "path"});
  if (object.has("box") == object.has("quad")) {
    object.fail(nullptr, "needs a box or a quad, and only one of them", "write \"box\" or \"quad\"");
  }
  PlacedCatcher catcher = object.has("box") ? parse_box_catcher(object.object("box")) : parse_quad(object);

  Material material = parse_catcher_material(object, object.text_or("name", object.where()));
  catcher.mesh.name = material.name;

  Instance instance;
  instance.name = material.name;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  instance.material = static_cast<std::uint32_t>(scene.materials.size());
  instance.world_from_object[3] = catcher.centre;
  instance.catcher = true;
  instance.present = object.boolean_or("present", true);
  scene.meshes.push_back(std::move(catcher.mesh));
  scene.materials.push_back(std::move(material));
  scene.instances.push_back(std::move(instance));
  if (object.has("path")) put_on_path(object, scene);
}

std::optional<Exposure> parse_exposure(const JsonObject& root) {
  const bool automatic = root.boolean_or("auto_exposure", false);
  if (!root.has("exposure_ev")) return automatic ? std::optional(Exposure{true, 0}) : std::nullopt;
  if (automatic) root.fail("auto_exposure", "stands beside exposure_ev", "write only one of them");
  return Exposure{false, root.number("exposure_ev", -kMostExposure_ev, kMostExposure_ev)};
}

ProbeGridSpec parse_probes(const JsonObject& object) {
  object.allow_only({"counts", "min", "max"});
  ProbeGridSpec probes;
  if (object.has("counts")) {
    const std::vector<double> counts = object.numbers("counts", 3, 1, kMostProbes);
    double product = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (counts[axis] != std::floor(counts[axis])) {
        object.fail("counts", "is not three whole numbers", "write for example [16, 8, 16]");
      }
      probes.counts[axis] = static_cast<int>(counts[axis]);
      product *= counts[axis];
    }
    if (product > kMostProbes) {
      object.fail("counts", "makes more than " + std::to_string(kMostProbes) + " probes",
                  "write smaller numbers");
    }
  }
  if (object.has("min") != object.has("max")) {
    object.fail(nullptr, "has only one of min and max", "write both, or neither for the scene's bounds");
  }
  if (!object.has("min")) return probes;
  probes.box = Bounds{object.vec3("min", -kFarthestPlace_m, kFarthestPlace_m),
                      object.vec3("max", -kFarthestPlace_m, kFarthestPlace_m)};
  for (int axis = 0; axis < 3; ++axis) {
    if (probes.box->upper[axis] < probes.box->lower[axis]) {
      object.fail("max", "is below min on an axis", "swap the two numbers");
    }
  }
  return probes;
}

PlaybackRequest parse_playback(const JsonObject& object) {
  object.allow_only({"clip", "play", "speed", "loop", "offset_s"});
  PlaybackRequest playback;
  playback.play = object.boolean_or("play", true);
  if (object.has("clip")) {
    if (object.is_text("clip"))
      playback.name = object.text("clip");
    else
      playback.number = static_cast<int>(object.integer("clip", 0, 1'000'000));
  }
  playback.speed = object.number_or("speed", -1000, 1000, 1);
  playback.offset_s = object.number_or("offset_s", -1e6, 1e6, 0);
  playback.loop = object.boolean_or("loop", true);
  return playback;
}

AreaLight parse_light(const JsonObject& object) {
  object.allow_only({"name", "kind", "centre", "size", "intensity_w_sr", "irradiance_w_m2", "direction",
                     "inner_cone_deg", "outer_cone_deg", "range_m", "path", "virtual"});
  AreaLight light;
  light.name = object.text_or("name", object.where());
  light.is_virtual = object.boolean_or("virtual", false);
  light.kind = parse_light_kind(object);
  if (light.kind == LightKind::sun) {
    light.intensity_w_sr = glm::vec3(object.vec3("irradiance_w_m2", 0, kBrightest));
  } else {
    light.centre = object.vec3("centre", -kFarthestPlace_m, kFarthestPlace_m);
    light.intensity_w_sr = glm::vec3(object.vec3("intensity_w_sr", 0, kStrongest_w_sr));
    light.range_m = object.number_or("range_m", 0, kFarthestPlace_m, 0);
  }
  if (light.kind == LightKind::box)
    light.size = glm::vec3(object.vec3_or("size", 0, kLargest_m, glm::dvec3(0.0)));
  if (light.kind != LightKind::box) light.direction = parse_direction(object);
  if (light.kind == LightKind::spot) {
    light.outer_cone_rad = glm::radians(object.number_or("outer_cone_deg", 0.1, 90, 45));
    light.inner_cone_rad = glm::radians(object.number_or("inner_cone_deg", 0, 90, 0));
    if (light.inner_cone_rad >= light.outer_cone_rad) {
      object.fail("inner_cone_deg", "is not below outer_cone_deg", "write a smaller angle");
    }
  }
  if (!object.has("path")) return light;
  const JsonObject path = object.object("path");
  path.allow_only({"circle_radius_m", "period_s", "phase_deg"});
  light.path_radius_m = path.number("circle_radius_m", 0, kLargest_m);
  light.path_period_s = path.number("period_s", 1e-3, 1e9);
  light.path_phase_deg = path.number_or("phase_deg", -360, 360, 0);
  return light;
}

}  // namespace herr
