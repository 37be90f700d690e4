#include "scenes/voxels/triangle_voxels.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace herr {
namespace {

struct CellRange {
  glm::ivec3 first{0}, last{-1};
};

// Cells of the triangle's own box, within the grid. A corner on a face touches both sides.
CellRange cells_of(const TriangleCorners& t, const glm::ivec3& counts) {
  const glm::dvec3 lower = glm::min(t[0], glm::min(t[1], t[2])), upper = glm::max(t[0], glm::max(t[1], t[2]));
  CellRange range;
  for (int axis = 0; axis < 3; ++axis) {
    const double last = counts[axis] - 1;
    range.first[axis] = static_cast<int>(std::clamp(std::ceil(lower[axis]) - 1, 0.0, last));
    range.last[axis] = static_cast<int>(std::clamp(std::floor(upper[axis]), 0.0, last));
  }
  return range;
}

// The axis that is nearest to the triangle's normal.
int flattest_axis(const glm::dvec3& normal) {
  const glm::dvec3 n = glm::abs(normal);
  return n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
}

// Do the triangle and the box of half edges 1/2 about the origin overlap along `axis`?
bool overlap_along(const glm::dvec3& axis, const TriangleCorners& t) {
  const double a = glm::dot(axis, t[0]), b = glm::dot(axis, t[1]), c = glm::dot(axis, t[2]);
  const double reach = 0.5 * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
  return std::min({a, b, c}) <= reach && std::max({a, b, c}) >= -reach;
}

}  // namespace

bool touches(const TriangleCorners& triangle, const glm::ivec3& voxel) {
  const glm::dvec3 centre = glm::dvec3(voxel) + 0.5;
  const TriangleCorners t{triangle[0] - centre, triangle[1] - centre, triangle[2] - centre};
  const glm::dvec3 edges[3] = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 unit(0.0);
    unit[axis] = 1;
    if (!overlap_along(unit, t)) return false;
    for (const glm::dvec3& edge : edges) {
      if (!overlap_along(glm::cross(unit, edge), t)) return false;
    }
  }
  return overlap_along(glm::cross(edges[0], edges[1]), t);
}

std::int64_t column_count(const TriangleCorners& triangle, const glm::ivec3& counts) {
  const CellRange range = cells_of(triangle, counts);
  const int depth = flattest_axis(glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
  std::int64_t columns = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis != depth) columns *= range.last[axis] - range.first[axis] + 1;
  }
  return columns;
}

void for_each_touched(const TriangleCorners& triangle, const glm::ivec3& counts,
                      const std::function<void(const glm::ivec3&)>& visit) {
  const CellRange range = cells_of(triangle, counts);
  const glm::dvec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  const int depth = flattest_axis(normal), across = (depth + 1) % 3, along = (depth + 2) % 3;
  for (int j = range.first[along]; j <= range.last[along]; ++j) {
    for (int i = range.first[across]; i <= range.last[across]; ++i) {
      int first = range.first[depth], last = range.last[depth];
      if (normal[depth] != 0) {
        // Depths of the plane over the column's four corners; one cell more for rounding.
        const double slope_i = -normal[across] / normal[depth], slope_j = -normal[along] / normal[depth];
        const double at_corner =
            triangle[0][depth] + slope_i * (i - triangle[0][across]) + slope_j * (j - triangle[0][along]);
        const double lower = at_corner + std::min(slope_i, 0.0) + std::min(slope_j, 0.0);
        const double upper = at_corner + std::max(slope_i, 0.0) + std::max(slope_j, 0.0);
        first = static_cast<int>(std::clamp(std::floor(lower) - 1, double(first), double(last) + 1));
        last =
            static_cast<int>(std::clamp(std::floor(upper) + 1, double(range.first[depth]) - 1, double(last)));
      }
      for (int k = first; k <= last; ++k) {
        glm::ivec3 voxel{0};
        voxel[depth] = k, voxel[across] = i, voxel[along] = j;
        if (touches(triangle, voxel)) visit(voxel);
      }
    }
  }
}

glm::dvec3 nearest_weights(const TriangleCorners& t, const glm::dvec3& point) {
  const glm::dvec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = point - t[0], bp = point - t[1],
                   cp = point - t[2];
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp),
               d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 != d3) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 != d6) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double e = d4 - d3, f = d5 - d6;
  if (va <= 0 && e >= 0 && f >= 0 && e + f > 0) return {0, 1 - e / (e + f), e / (e + f)};
  const double sum = va + vb + vc;
  if (!(sum != 0)) return {1, 0, 0};  // a triangle without area that lies here is as good as its corner
  return {va / sum, vb / sum, vc / sum};
}

}  // namespace herr
