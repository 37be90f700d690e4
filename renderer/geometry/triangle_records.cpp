#include "renderer/geometry/triangle_records.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderer/memory_use.h"

namespace herr {
namespace {

std::uint32_t snorm16(float x) {
  const long rounded = std::lround(std::clamp(x, -1.0f, 1.0f) * 32767.0f);
  return static_cast<std::uint32_t>(static_cast<std::uint16_t>(static_cast<std::int16_t>(rounded)));
}

float unsnorm16(std::uint32_t bits) {
  return static_cast<float>(static_cast<std::int16_t>(bits & 0xffffu)) / 32767.0f;
}

// As encode_octahedral takes it.
glm::vec3 unit_normal(const glm::vec3& n) {
  const float length2 = glm::dot(n, n);
  return length2 > 0 ? n / std::sqrt(length2) : glm::vec3(0, 1, 0);
}

float sign_not_zero(float x) {
  return x >= 0 ? 1.0f : -1.0f;
}

std::uint32_t unorm16(float x) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(x, 0.0f, 1.0f) * 65535.0f));
}

// Area in coordinates over area in space of one triangle; 0 where it has no area.
float texel_density(const TriangleMesh& mesh, const std::vector<glm::vec2>& uvs,
                    const std::array<std::uint32_t, 3>& t) {
  const glm::dvec3 a(mesh.positions[t[0]]);
  const double area =
      glm::length(glm::cross(glm::dvec3(mesh.positions[t[1]]) - a, glm::dvec3(mesh.positions[t[2]]) - a));
  const glm::dvec2 p{uvs[t[0]]};
  const glm::dvec2 e = glm::dvec2{uvs[t[1]]} - p, f = glm::dvec2{uvs[t[2]]} - p;
  const double uv_area = std::abs(e.x * f.y - e.y * f.x);
  return area > 0 ? static_cast<float>(std::min(uv_area / area, 1e30)) : 0.0f;
}

// Fills in the coordinates of records that are there already.
void bake_coordinates(const TriangleMesh& mesh, const std::vector<glm::vec2>& uvs, BakedCoordinates& baked) {
  if (uvs.empty()) return;
  glm::vec2 upper = baked.uv_lower = uvs.front();
  for (const glm::vec2& uv : uvs) {
    baked.uv_lower = glm::min(baked.uv_lower, uv);
    upper = glm::max(upper, uv);
  }
  baked.uv_scale = upper - baked.uv_lower;
  const glm::vec2 safe_scale = glm::max(baked.uv_scale, glm::vec2{1e-20f});
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& triangle = mesh.triangles[i];
    TriangleRecord& record = baked.records[i];
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const glm::vec2 uv = (uvs[triangle[corner]] - baked.uv_lower) / safe_scale;
      record.uv[corner] = unorm16(uv.x) | unorm16(uv.y) << 16;
    }
    record.texel_density = texel_density(mesh, uvs, triangle);
  }
}

ColourRecord bake_colours(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  ColourRecord record;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const glm::vec4& c = mesh.colours[triangle[corner]];
    record.rgba[2 * corner] = unorm16(c.x) | unorm16(c.y) << 16;
    record.rgba[2 * corner + 1] = unorm16(c.z) | unorm16(c.w) << 16;
  }
  return record;
}

TangentRecord bake_tangents(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  TangentRecord record;
  for (std::size_t corner = 0; corner < 3; ++corner)
    record.tangent[corner] = encode_octahedral(glm::vec3(mesh.tangents[triangle[corner]]));
  record.handedness = common_handedness(mesh.tangents[triangle[0]].w, mesh.tangents[triangle[1]].w,
                                        mesh.tangents[triangle[2]].w);
  return record;
}

// Per axis, the largest coordinate of a corner and the largest difference of two.
glm::vec3 rounded_extents(const std::array<glm::vec3, 3>& p) {
  const glm::vec3 lower = glm::min(glm::min(p[0], p[1]), p[2]), upper = glm::max(glm::max(p[0], p[1]), p[2]);
  return glm::max(glm::abs(lower), glm::abs(upper)) + (upper - lower);
}

}  // namespace

float common_handedness(float a, float b, float c) {
  return a + b + c < 0 ? -1.0f : 1.0f;
}

float shading_curvature(const std::array<glm::vec3, 3>& corners, const std::array<glm::vec3, 3>& normals) {
  float longest2 = 0, fastest2 = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    const glm::vec3 edge = corners[next] - corners[i], turn = normals[next] - normals[i];
    const float length2 = glm::dot(edge, edge);
    longest2 = std::max(longest2, length2);
    if (length2 > 0) fastest2 = std::max(fastest2, glm::dot(turn, turn) / length2);
  }
  if (!(fastest2 > 0)) return 0.0f;
  // The normal is linear over the triangle, with the gradient (t0 f - t1 e) / |e x f| across its plane, from
  // edges e and f and turns t0 and t1 along them. Half its squared Frobenius norm is the mean over
  // directions.
  const float scale = 1.0f / std::sqrt(longest2);
  const glm::vec3 e = scale * (corners[1] - corners[0]), f = scale * (corners[2] - corners[0]);
  const glm::vec3 t0 = normals[1] - normals[0], t1 = normals[2] - normals[0];
  const glm::vec3 area = glm::cross(e, f);
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const glm::vec3 across = t0[axis] * f - t1[axis] * e;
    sum += glm::dot(across, across);
  }
  const float area2 = glm::dot(area, area);
  const float mean2 = area2 > 0 ? 0.5f * sum / area2 * scale * scale : fastest2;
  return std::min(std::sqrt(mean2 < fastest2 ? mean2 : fastest2), 1e30f);
}

float rounded_length(const std::array<glm::vec3, 3>& corners) {
  const glm::dvec3 a(corners[0]);
  const glm::dvec3 area = glm::cross(glm::dvec3(corners[1]) - a, glm::dvec3(corners[2]) - a);
  const double length = glm::length(area);
  if (!(length > 0)) return 0;
  return static_cast<float>(glm::dot(glm::abs(area) / length, glm::dvec3(rounded_extents(corners))));
}

float most_rounded_length(const std::array<glm::vec3, 3>& corners) {
  return glm::length(rounded_extents(corners));
}

std::uint32_t curvature_and_rounding(float curvature, float length) {
  constexpr std::uint32_t kLastBits = 0xffu, kMantissa = 0x7fffffu, kLargestExponent = 254;
  const std::uint32_t exponent =
      std::min((std::bit_cast<std::uint32_t>(std::max(length, 0.0f)) + kMantissa) >> 23, kLargestExponent);
  return (std::bit_cast<std::uint32_t>(curvature) & ~kLastBits) | exponent;
}

std::uint32_t encode_octahedral(const glm::vec3& n) {
  const float norm = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  if (!(norm > 0)) return encode_octahedral({0, 1, 0});
  glm::vec2 p{n.x / norm, n.y / norm};
  if (n.z < 0) p = {(1 - std::abs(p.y)) * sign_not_zero(p.x), (1 - std::abs(p.x)) * sign_not_zero(p.y)};
  return snorm16(p.x) | snorm16(p.y) << 16;
}

glm::vec3 decode_octahedral(std::uint32_t code) {
  const float x = unsnorm16(code), y = unsnorm16(code >> 16);
  const float z = 1 - std::abs(x) - std::abs(y);
  const float fold = std::max(-z, 0.0f);
  return glm::normalize(glm::vec3{x - sign_not_zero(x) * fold, y - sign_not_zero(y) * fold, z});
}

BakedMesh bake_triangles(const TriangleMesh& mesh) {
  BakedMesh baked;
  baked.records.resize(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::array<glm::vec3, 3> places, directions;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = mesh.triangles[i][corner];
      baked.records[i].normal[corner] = encode_octahedral(mesh.normals[vertex]);
      places[corner] = mesh.positions[vertex];
      directions[corner] = unit_normal(mesh.normals[vertex]);
    }
    baked.records[i].curvature_and_rounding =
        curvature_and_rounding(shading_curvature(places, directions), rounded_length(places));
  }
  bake_coordinates(mesh, mesh.uvs, baked);
  for (const auto& uvs : mesh.more_uvs) {
    BakedCoordinates& set = baked.more.emplace_back();
    set.records.resize(mesh.triangles.size());
    bake_coordinates(mesh, uvs, set);
  }
  if (!mesh.colours.empty()) {
    baked.colours.reserve(mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) baked.colours.push_back(bake_colours(mesh, triangle));
  }
  if (!mesh.tangents.empty()) {
    baked.tangents.reserve(mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) baked.tangents.push_back(bake_tangents(mesh, triangle));
  }
  return baked;
}

std::int64_t BakedMesh::bytes() const {
  std::int64_t sum = bytes_of(records) + bytes_of(colours) + bytes_of(tangents);
  for (const BakedCoordinates& set : more) sum += bytes_of(set.records);
  return sum;
}

}  // namespace herr
