#include "scenes/gltf/mesh_unit.h"

#include <algorithm>
#include <cmath>

namespace herr {
namespace {

constexpr int kSmallestExponent = -10, kLargestExponent = 20;  // of what stays as it is

}  // namespace

double take_unit(TriangleMesh& mesh) {
  float farthest = 0;
  for (const glm::vec3& p : mesh.positions)
    farthest = std::max({farthest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  if (!(farthest > 0)) return 1;
  const int exponent = std::ilogb(farthest);
  if (exponent >= kSmallestExponent && exponent < kLargestExponent) return 1;
  for (glm::vec3& p : mesh.positions) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::ldexp(p[axis], -exponent);
  }
  return std::ldexp(1.0, exponent);
}

}  // namespace herr
