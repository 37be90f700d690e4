// Brings the coordinates of a mesh near 1, so that what is made of them fits a float however large its unit
// is: exact, for the unit is a power of two. Before: mesh_builder. After: load_gltf, whose instances undo it.
#pragma once

#include "scenes/model/scene.h"

namespace herr {

// Divides the positions by the power of two that makes the farthest coordinate 1 or just more, and returns
// it; 1 where that lies between 2^-10 and 2^20 as it is.
double take_unit(TriangleMesh& mesh);

}  // namespace herr
