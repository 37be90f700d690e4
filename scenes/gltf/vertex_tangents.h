// Tangents of a mesh whose file has none, from the coordinates that its normal texture reads.
// Before: mesh_builder. After: load_gltf; animated_models asks for those of morphed shapes. glTF 2.0 section
// 3.7.2.1 recommends MikkTSpace. These are its: means over the triangles around a place, by angle, apart
// where coordinates are mirrored. Where coordinates say no direction, any across the normal is taken.
#pragma once

#include "scenes/gltf/mesh_builder.h"

namespace herr {

// Fills in built.mesh.tangents for coordinates `uv_set` of the mesh (as TextureSlot::uv_set). A vertex at
// which mirrored coordinates meet others becomes two: one tangent cannot serve both.
void make_tangents(BuiltMesh& built, int uv_set);

// Unit directions for a mesh that has had make_tangents, or tangents of its file: in its present shape.
// Vertices that differ in number or colour alone share theirs.
std::vector<glm::vec3> tangent_directions(const TriangleMesh& mesh, int uv_set);

}  // namespace herr
