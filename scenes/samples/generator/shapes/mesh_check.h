// What every generated mesh must satisfy before it is written. Before: objects/. After: glb_writer.
#pragma once

#include <string>

#include "scenes/samples/generator/shapes/mesh.h"

namespace herr::samples {

// Throws std::runtime_error naming the mesh and the first rule that it breaks: finite numbers, indices in
// range, unit normals (1e-4), at most 1 % of triangles without area, at most 1 % wound against their normals.
void check_mesh(const std::string& name, const Mesh& mesh);

// Volume enclosed by a closed mesh, cubic metres: negative when its triangles face inwards.
double enclosed_volume_m3(const Mesh& mesh);

}  // namespace herr::samples
