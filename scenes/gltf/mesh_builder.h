// Turns one glTF primitive into one TriangleMesh: strips and fans to triangles, vertices that no triangle
// uses left out, normals made where the file has none. Before: accessor_reader. After: load_gltf. Source:
// glTF 2.0 section 3.7.2.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/gltf/file/gltf_model.h"

namespace herr {

// What the primitives of one file may still use, so that many small ones cannot add up
// to more than the limits.
struct MeshBudget {
  std::int64_t triangles, decoded_elements;
  MeshBudget();
};

// Throws InputError where the budget does not reach. `what`: in the plural.
void spend(std::int64_t& budget, std::size_t amount, const GltfModel& model, const char* what);

struct BuiltMesh {
  TriangleMesh mesh;                   // no triangles: nothing to draw, `warnings` says why
  std::vector<std::string> warnings;   // without the file's name
  std::vector<std::uint32_t> sources;  // per vertex: which of the primitive it is
};

// `sources`: the coordinates that the material reads; mesh.uvs and more_uvs are them,
// transformed, in the same order. The primitive has all of them. `with_tangents`: reads TANGENT
// too, where the file has it and NORMAL.
BuiltMesh build_mesh(const GltfModel& model, const GltfPrimitive& primitive,
                     const std::vector<UvSource>& sources, bool with_tangents, MeshBudget& budget);

// Flat normals: every triangle gets its own three vertices. As the specification asks when NORMAL is absent.
void make_flat(TriangleMesh& mesh);

}  // namespace herr
