// Bicubic Bezier patches, as the teapot was published.
#pragma once

#include <array>

#include "scenes/samples/generator/shapes/mesh.h"

namespace herr::samples {

using BezierCurve = std::array<glm::vec3, 4>;
using BezierPatch = std::array<BezierCurve, 4>;  // [row][column]: u runs along a row, v across rows

glm::vec3 bezier_point(const BezierPatch& patch, float u, float v);

// (2 * segments^2) triangles less those that collapse at a pole; d/du x d/dv is outwards.
Mesh bezier_mesh(const BezierPatch& patch, int segments);

}  // namespace herr::samples
