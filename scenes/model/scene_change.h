// One change of a scene, of a session's events.jsonl or of a scene document's timeline.
// Before: parse_change reads it. After: world applies it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "scenes/model/material_override.h"
#include "scenes/model/placement.h"

namespace herr {

enum class ChangeKind : std::uint8_t { spawn, remove, move, set_light, set_material, replace_mesh };

struct LightChange {
  std::optional<glm::vec3> intensity_w_sr;  // of a sun: irradiance
  std::optional<glm::dvec3> centre, direction;
  std::optional<glm::vec3> size;
  std::optional<bool> is_virtual;
};

struct SceneChange {
  double time_s = 0;  // since the session's start
  ChangeKind kind = ChangeKind::move;
  std::string name;                          // of the object or light that changes
  std::string of;                            // spawn, replace_mesh: the object of the document that is copied
  PlacementChange placement;                 // spawn, move
  LightChange light;                         // set_light
  std::optional<MaterialOverride> material;  // set_material; spawn, if at all
};

}  // namespace herr
