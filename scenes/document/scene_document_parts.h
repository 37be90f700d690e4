// The parts of a scene document, each from its JSON object: poses, materials, catchers, lights.
// Before: scene_document walks the document. Every function throws InputError that names the field.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x3.hpp>
#include <optional>
#include <string>

#include "scenes/gltf/animated_models.h"
#include "scenes/model/material_override.h"
#include "scenes/model/placement.h"
#include "scenes/model/scene.h"
#include "sessions/files/strict_json.h"

namespace herr {

// A quaternion x, y, z, w of length 1 within 1e-3 (normalised); the identity when absent.
glm::dquat parse_orientation(const JsonObject& object, const char* key);
// world_from_session: {"position", "orientation_xyzw"}.
Pose parse_pose(const JsonObject& object);
// translation, rotation_xyzw and scale, as far as they are given; a scale of 0 is refused by name.
PlacementChange parse_placement_change(const JsonObject& entry);
// Those of an entry, the identity where they are absent.
glm::dmat4x3 parse_placement(const JsonObject& entry);

// What a scene document or an event changes about the materials of an object.
MaterialOverride parse_material_override(const JsonObject& object);

// What a real surface looks like to light: base_colour, metallic, roughness, mirror.
Material parse_catcher_material(const JsonObject& object, const std::string& name);
// Appends the mesh, material and instance of a box or quad.
void append_catcher(const JsonObject& object, Scene& scene);
// probes: {"counts", "min", "max"}.
ProbeGridSpec parse_probes(const JsonObject& object);
// exposure_ev or auto_exposure of a document; none where it has neither.
std::optional<Exposure> parse_exposure(const JsonObject& root);
// animation: {"clip", "play", "speed", "loop", "offset_s"}.
PlaybackRequest parse_playback(const JsonObject& object);
AreaLight parse_light(const JsonObject& object);

}  // namespace herr
