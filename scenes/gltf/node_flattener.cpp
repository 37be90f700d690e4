#include "scenes/gltf/node_flattener.h"

#include <glm/geometric.hpp>
#include <utility>

#include "scenes/gltf/file/gltf_limits.h"
#include "scenes/gltf/file/gpu_instances.h"
#include "scenes/model/transform_checks.h"
#include "sessions/files/input_error.h"

namespace herr {

AreaLight placed_light(const glm::dmat4x3& world_from_light, AreaLight light) {
  light.centre = world_from_light * glm::dvec4(light.centre, 1.0);
  const glm::dvec3 direction = world_from_light * glm::dvec4(light.direction, 0.0);
  const double length = glm::length(direction);
  if (length > 0) light.direction = direction / length;
  return light;
}

FlattenedNodes flatten_nodes(const GltfModel& model) {
  // An explicit stack: a chain of 100,000 nodes must not overflow the program's own.
  std::vector<std::pair<int, glm::dmat4x3>> open;  // node, gltf_from_parent
  for (auto root = model.roots.rbegin(); root != model.roots.rend(); ++root) open.emplace_back(*root, 1.0);
  FlattenedNodes placed;
  while (!open.empty()) {
    const auto [index, gltf_from_parent] = open.back();
    open.pop_back();
    const GltfNode& node = model.nodes[static_cast<std::size_t>(index)];
    if (!node.visible) continue;
    const glm::dmat4x3 gltf_from_node = compose(gltf_from_parent, node.parent_from_node);
    if (node.mesh >= 0) {
      const std::string& mesh_name = model.meshes[static_cast<std::size_t>(node.mesh)].name;
      for (const glm::dmat4x3& node_from_instance : instance_transforms(model, node)) {
        const glm::dmat4x3 gltf_from_mesh = compose(gltf_from_node, node_from_instance);
        placed.meshes.push_back({node.name.empty() ? mesh_name : node.name, node.mesh, gltf_from_mesh, index,
                                 node_from_instance});
      }
      if (static_cast<std::int64_t>(placed.meshes.size()) > kMaxInstances) {
        throw InputError(model.file, 0, "has more than a million instances", "merge some of its nodes");
      }
    }
    if (node.light >= 0) {
      AreaLight light = model.lights[static_cast<std::size_t>(node.light)];
      light.direction = {0, 0, -1};
      if (light.name.empty()) light.name = node.name;
      placed.lights.push_back(placed_light(gltf_from_node, light));
    }
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
      open.emplace_back(*child, gltf_from_node);
    }
  }
  return placed;
}

}  // namespace herr
