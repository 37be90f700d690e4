#include "scenes/samples/generator/shapes/bezier_patch.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/samples/generator/shapes/grid.h"

namespace herr::samples {

namespace {

glm::vec3 curve_point(const BezierCurve& c, float t) {
  const float s = 1.0f - t;
  return s * s * s * c[0] + 3.0f * s * s * t * c[1] + 3.0f * s * t * t * c[2] + t * t * t * c[3];
}

glm::vec3 curve_derivative(const BezierCurve& c, float t) {
  const float s = 1.0f - t;
  return 3.0f * (s * s * (c[1] - c[0]) + 2.0f * s * t * (c[2] - c[1]) + t * t * (c[3] - c[2]));
}

BezierCurve across_rows(const BezierPatch& patch, float u) {
  return {curve_point(patch[0], u), curve_point(patch[1], u), curve_point(patch[2], u),
          curve_point(patch[3], u)};
}

glm::vec3 patch_normal(const BezierPatch& patch, float u, float v) {
  // At a pole a whole row of control points coincides and one derivative vanishes: the limit of the
  // normal is taken a little inside.
  v = glm::clamp(v, 1e-3f, 1.0f - 1e-3f);
  BezierCurve along_row;
  for (std::size_t column = 0; column < 4; ++column) {
    along_row[column] =
        curve_point({patch[0][column], patch[1][column], patch[2][column], patch[3][column]}, v);
  }
  const glm::vec3 du = curve_derivative(along_row, u);
  const glm::vec3 dv = curve_derivative(across_rows(patch, u), v);
  return glm::normalize(glm::cross(du, dv));
}

}  // namespace

glm::vec3 bezier_point(const BezierPatch& patch, float u, float v) {
  return curve_point(across_rows(patch, u), v);
}

Mesh bezier_mesh(const BezierPatch& patch, int segments) {
  return grid_mesh(segments, segments, [&](float u, float v) {
    return Vertex{bezier_point(patch, u, v), patch_normal(patch, u, v), {u, v}};
  });
}

}  // namespace herr::samples
