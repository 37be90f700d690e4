// Triangle meshes as the sample generator makes them, and how parts are joined into one object.
// Before: shapes/ and objects/ fill meshes. After: mesh_check judges them, glb_writer stores them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace herr::samples {

inline constexpr float kPi = 3.14159265358979f;

// One vertex of a surface.
struct Vertex {
  glm::vec3 position{0.0f};  // metres
  glm::vec3 normal{0.0f};    // unit, outwards
  glm::vec2 uv{0.0f};        // (0, 0) is the top left of the picture
};

// Positions, normals and uvs have the same length. Triangles are counter-clockwise seen from outside.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> uvs;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// The part of a picture that a piece of an object uses: several parts share one picture this way.
struct UvRect {
  glm::vec2 lower{0.0f}, upper{1.0f};
};

// Returns the index of the new vertex.
std::uint32_t add_vertex(Mesh& mesh, const Vertex& vertex);

// Adds a triangle unless its area vanishes (as at the poles of grids).
void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c);

// Adds `part`, moved by `object_from_part` (no shear; a mirror image keeps its outside outside).
void append(Mesh& object, const Mesh& part, const glm::mat4& object_from_part, const UvRect& rect = {});

// Moves a mesh so that it stands on y = 0.
void stand_on_ground(Mesh& mesh);

// Replaces the normals by the area-weighted mean of the triangles around each vertex.
void compute_normals(Mesh& mesh);

// Twice the area of a triangle, along its outward normal.
glm::vec3 area_normal(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle);

}  // namespace herr::samples
