// Writes binary glTF 2.0 files, the same bytes for the same object. Before: mesh_check. After: scenes/ reads
// them. Source: glTF 2.0 specification, section 4 (GLB).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenes/samples/generator/pictures/picture.h"
#include "scenes/samples/generator/shapes/mesh.h"

namespace herr::samples {

// glTF metallic-roughness.
struct GlbMaterial {
  std::string name;
  glm::vec3 base_colour{0.8f};  // linear; multiplies the picture
  float metallic = 0.0f;        // [0, 1]
  float roughness = 0.8f;       // [0, 1]
  glm::vec3 emission{0.0f};     // linear, [0, 1]
  std::optional<Picture> picture;
};

struct GlbPart {
  Mesh mesh;
  GlbMaterial material;
};

// One node whose mesh has one primitive per part.
struct GlbObject {
  std::string name;
  std::vector<GlbPart> parts;
};

std::size_t triangle_count(const GlbObject& object);

// Replaces `file` only when all of it is written. Throws std::runtime_error otherwise.
void write_glb(const std::filesystem::path& file, const GlbObject& object);

}  // namespace herr::samples
