#include "scenes/gltf/node_flattener.h"

#include <utility>

#include "scenes/transform_checks.h"
#include "sessions/input_error.h"

namespace herr {

std::vector<PlacedMesh> flatten_nodes(const GltfModel& model) {
  // An explicit stack: a chain of 100,000 nodes must not overflow the program's own.
  std::vector<std::pair<int, glm::dmat4x3>> open;  // node, gltf_from_parent
  for (auto root = model.roots.rbegin(); root != model.roots.rend(); ++root) open.emplace_back(*root, 1.0);
  std::vector<PlacedMesh> placed;
  while (!open.empty()) {
    const auto [index, gltf_from_parent] = open.back();
    open.pop_back();
    const GltfNode& node = model.nodes[static_cast<std::size_t>(index)];
    const glm::dmat4x3 gltf_from_node = compose(gltf_from_parent, node.parent_from_node);
    if (node.mesh >= 0) {
      const std::string& mesh_name = model.meshes[static_cast<std::size_t>(node.mesh)].name;
      if (const auto problem = transform_problem(gltf_from_node)) {
        throw InputError(model.file, 0,
                         "the transform of nodes[" + std::to_string(index) + "] \"" + printable(node.name) +
                             "\" " + *problem,
                         "give the node a scale that is not 0, or remove it");
      }
      placed.push_back({node.name.empty() ? mesh_name : node.name, node.mesh, gltf_from_node});
    }
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
      open.emplace_back(*child, gltf_from_node);
    }
  }
  return placed;
}

}  // namespace herr
