#include "renderer/geometry/triangle_records.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace herr {
namespace {

std::uint32_t snorm16(float x) {
  const long rounded = std::lround(std::clamp(x, -1.0f, 1.0f) * 32767.0f);
  return static_cast<std::uint32_t>(static_cast<std::uint16_t>(static_cast<std::int16_t>(rounded)));
}

float unsnorm16(std::uint32_t bits) {
  return static_cast<float>(static_cast<std::int16_t>(bits & 0xffffu)) / 32767.0f;
}

float sign_not_zero(float x) {
  return x >= 0 ? 1.0f : -1.0f;
}

std::uint32_t unorm16(float x) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(x, 0.0f, 1.0f) * 65535.0f));
}

}  // namespace

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
  if (!mesh.uvs.empty()) {
    glm::vec2 upper = baked.uv_lower = mesh.uvs.front();
    for (const glm::vec2& uv : mesh.uvs) {
      baked.uv_lower = glm::min(baked.uv_lower, uv);
      upper = glm::max(upper, uv);
    }
    baked.uv_scale = upper - baked.uv_lower;
  }
  const glm::vec2 safe_scale = glm::max(baked.uv_scale, glm::vec2{1e-20f});
  baked.records.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    TriangleRecord record{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      record.normal[corner] = encode_octahedral(mesh.normals[triangle[corner]]);
      if (mesh.uvs.empty()) continue;
      const glm::vec2 uv = (mesh.uvs[triangle[corner]] - baked.uv_lower) / safe_scale;
      record.uv[corner] = unorm16(uv.x) | unorm16(uv.y) << 16;
    }
    baked.records.push_back(record);
  }
  return baked;
}

}  // namespace herr
