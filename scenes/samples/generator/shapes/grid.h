// A surface over a rectangle of parameters, as a grid of triangles. Lathes, tubes and patches are grids.
#pragma once

#include <functional>

#include "scenes/samples/generator/shapes/mesh.h"

namespace herr::samples {

// Evaluates `surface` at (columns + 1) x (rows + 1) points of [0, 1]^2; d/du x d/dv points outwards.
// Cells that collapse to a line give no triangles.
Mesh grid_mesh(int columns, int rows, const std::function<Vertex(float u, float v)>& surface);

// The same with the normal taken from central differences of the position; `normal`
// of the surface is ignored.
Mesh smooth_grid_mesh(int columns, int rows, const std::function<Vertex(float u, float v)>& surface);

}  // namespace herr::samples
