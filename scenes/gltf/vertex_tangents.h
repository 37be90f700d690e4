// Tangents of a mesh whose file has none, from the coordinates that its normal texture reads.
// Before: mesh_builder. After: load_gltf. glTF 2.0 section 3.7.2.1 recommends MikkTSpace; this is its mean
// over the triangles of a vertex, weighted by angle, without its tie-breaking.
#pragma once

#include "scenes/gltf/mesh_builder.h"

namespace herr {

// Fills in built.mesh.tangents for coordinates `uv_set` of the mesh (as TextureSlot::uv_set). A vertex at
// which mirrored coordinates meet others becomes two: one tangent cannot serve both. Where coordinates do not
// say a direction, any across the normal is taken.
void make_tangents(BuiltMesh& built, int uv_set);

// Unit and perpendicular to a unit normal; the same for the same normal.
glm::vec3 any_tangent(const glm::vec3& normal);

}  // namespace herr
