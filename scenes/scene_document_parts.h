// The parts of a scene document, each from its JSON object: poses, materials, catchers, lights.
// Before: scene_document walks the document. Every function throws InputError that names the field.
#pragma once

#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x3.hpp>
#include <optional>
#include <string>

#include "scenes/scene.h"
#include "sessions/strict_json.h"

namespace herr {

// The file that a field names: below the folder of the scene document, so that a scene can be copied as a
// folder.
std::filesystem::path named_file(const JsonObject& entry, const char* key);

// A quaternion x, y, z, w of length 1 within 1e-3 (normalised); the identity when absent.
glm::dquat parse_orientation(const JsonObject& object, const char* key);
// world_from_session: {"position", "orientation_xyzw"}.
Pose parse_pose(const JsonObject& object);
// translation, rotation_xyzw and scale of a glTF entry; a scale of 0 is refused by name.
glm::dmat4x3 parse_placement(const JsonObject& entry);

// What a scene document changes about the materials of a glTF file.
struct MaterialOverride {
  std::optional<glm::vec3> base_colour, emission;
  std::optional<float> metallic, roughness, mirror, transmission, refractive_index;
  Material apply(Material material) const;
};
MaterialOverride parse_material_override(const JsonObject& object);

// Appends the mesh, material and instance of a box or quad.
void append_catcher(const JsonObject& object, Scene& scene);
// probes: {"counts", "min", "max"}.
ProbeGridSpec parse_probes(const JsonObject& object);
AreaLight parse_light(const JsonObject& object);

}  // namespace herr
