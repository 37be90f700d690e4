// Flattens the node tree to one level: the ray tracer has exactly one level of instances.
// Before: read_gltf (the nodes are a forest). After: load_gltf.
#pragma once

#include <glm/mat4x3.hpp>
#include <string>
#include <vector>

#include "scenes/gltf/gltf_model.h"

namespace herr {

// A mesh where a node puts it.
struct PlacedMesh {
  std::string name;  // of the node, or of its mesh when the node has none
  int mesh = 0;      // index into GltfModel::meshes
  glm::dmat4x3 gltf_from_mesh{1.0};
};

// Depth first, in the order of the file. Throws InputError for a transform that cannot be rendered.
std::vector<PlacedMesh> flatten_nodes(const GltfModel& model);

}  // namespace herr
