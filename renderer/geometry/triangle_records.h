// Bakes a mesh's per-corner attributes into the 32-byte records that shading gathers by triangle.
// Octahedral normals: Cigolle et al., "A Survey of Efficient Representations for
// Independent Unit Vectors" (2014).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "renderer/geometry/shading_scene.h"
#include "scenes/model/scene.h"

namespace herr {

struct BakedCoordinates {
  std::vector<TriangleRecord> records;  // one per triangle
  glm::vec2 uv_lower{0.0f};
  glm::vec2 uv_scale{0.0f};  // uv = lower + scale * (unorm / 65535)
};
struct BakedMesh : BakedCoordinates {
  std::vector<BakedCoordinates> more;   // of TriangleMesh::more_uvs, without normals
  std::vector<ColourRecord> colours;    // empty where the mesh has none
  std::vector<TangentRecord> tangents;  // likewise
  std::int64_t bytes() const;
};
BakedMesh bake_triangles(const TriangleMesh& mesh);

// Of a triangle, from its corners' (1 or -1).
float common_handedness(float a, float b, float c);

// How fast the interpolated normal turns along a triangle: the root of the mean square over directions,
// radians per unit of length; 1 / r on a sphere, 0 where the corners' normals, unit, agree. At most what it
// turns by along the edge where it turns fastest: across a sliver the rest would be rounding.
float shading_curvature(const std::array<glm::vec3, 3>& corners, const std::array<glm::vec3, 3>& normals);

// What rounds where a ray meets a triangle: corners, and differences to them, as far as they lie along its
// normal. So a level floor is exact in height however wide it is. 0: it has no area, and no ray meets it.
float rounded_length(const std::array<glm::vec3, 3>& corners);
// The same for a triangle of any direction, hence at least as much.
float most_rounded_length(const std::array<glm::vec3, 3>& corners);
// Of a curvature and the next power of two of a length, as TriangleRecord has them.
std::uint32_t curvature_and_rounding(float curvature, float length);

// Unit normal <-> two 16-bit snorms. Worst angle between a normal and its round trip: 0.0038 degrees, at the
// centre of a face of the octahedron.
std::uint32_t encode_octahedral(const glm::vec3& normal);
glm::vec3 decode_octahedral(std::uint32_t code);

}  // namespace herr
