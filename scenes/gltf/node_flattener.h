// Flattens the node tree to one level: the ray tracer has exactly one level of instances.
// Before: read_gltf (the nodes are a forest). After: load_gltf.
#pragma once

#include <glm/mat4x3.hpp>
#include <string>
#include <vector>

#include "scenes/gltf/file/gltf_model.h"

namespace herr {

// A mesh where a node puts it.
struct PlacedMesh {
  std::string name;  // of the node, or of its mesh when the node has none
  int mesh = 0;      // index into GltfModel::meshes
  glm::dmat4x3 gltf_from_mesh{1.0};
  int node = 0;  // index into GltfModel::nodes
  glm::dmat4x3 node_from_mesh{1.0};
};

struct FlattenedNodes {
  std::vector<PlacedMesh> meshes;
  std::vector<AreaLight> lights;  // where their nodes put them
};

// Depth first, in the order of the file. Throws InputError for more than a million. Transforms are as the
// file has them: load_gltf checks them with what they place.
FlattenedNodes flatten_nodes(const GltfModel& model);

// A light moved along: its place, and its direction as a vector. Brightness and range stay, as
// KHR_lights_punctual says of scaled nodes.
AreaLight placed_light(const glm::dmat4x3& world_from_light, AreaLight light);

}  // namespace herr
