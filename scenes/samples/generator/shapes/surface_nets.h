// Turns an implicit solid into triangles: naive surface nets (Gibson 1998), vertices pulled onto the surface.
#pragma once

#include <functional>

#include "scenes/samples/generator/shapes/mesh.h"

namespace herr::samples {

using DistanceField = std::function<float(const glm::vec3&)>;  // negative inside

struct NetBounds {
  glm::vec3 lower{0.0f}, upper{0.0f};
  float cell_m = 0.01f;  // edge of a cell; the solid must not reach the outermost cells
};

// Normals are the gradient of the field; uv is a slanted projection that fits the bounds.
Mesh surface_nets(const DistanceField& field, const NetBounds& bounds);

}  // namespace herr::samples
