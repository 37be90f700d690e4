#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "scenes/gltf/file/gltf_checks.h"
#include "scenes/gltf/file/gltf_limits.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

// How many entries each array of the document has: the bounds of every index.
struct Counts {
  std::int64_t accessors, meshes, materials, textures, images, samplers, nodes, skins;
};

std::int64_t size_of(const JsonObject& root, const char* key) {
  return root.has(key) && root.value(key).is_array() ? static_cast<std::int64_t>(root.value(key).size()) : 0;
}

void check_index(const JsonObject& object, const char* key, std::int64_t count) {
  if (object.has(key)) object.integer(key, 0, count - 1);
}

std::vector<std::int64_t> index_list(const JsonObject& object, const char* key, std::int64_t count) {
  std::vector<std::int64_t> indices;
  if (!object.has(key)) return indices;
  const nlohmann::json& list = object.value(key);
  if (!list.is_array()) object.fail(key, "is not an array", "write an array of indices");
  for (const nlohmann::json& item : list) {
    const bool in_range =
        item.is_number_unsigned() && item.get<std::uint64_t>() < static_cast<std::uint64_t>(count);
    if (!in_range) object.fail(key, "holds an index that does not exist", "export the model again");
    indices.push_back(item.get<std::int64_t>());
  }
  return indices;
}

void check_attributes(const JsonObject& primitive, const char* key, std::int64_t accessors) {
  const JsonObject attributes = primitive.object(key);
  for (const auto& [name, value] : primitive.value(key).items()) {
    attributes.integer(name.c_str(), 0, accessors - 1);
  }
}

void check_meshes(const JsonObject& root, const Counts& counts) {
  for (const JsonObject& mesh : root.objects("meshes")) {
    mesh.text_or("name", "");
    for (const JsonObject& primitive : mesh.objects("primitives")) {
      check_attributes(primitive, "attributes", counts.accessors);
      check_index(primitive, "indices", counts.accessors);
      check_index(primitive, "material", counts.materials);
      primitive.integer_or("mode", 0, 6, 4);
    }
  }
}

void check_textures(const JsonObject& root, const Counts& counts) {
  for (const JsonObject& texture : root.objects("textures")) {
    check_index(texture, "source", counts.images);
    check_index(texture, "sampler", counts.samplers);
  }
  for (const JsonObject& sampler : root.objects("samplers")) {
    for (const char* key : {"wrapS", "wrapT"}) {
      const std::int64_t wrap = sampler.integer_or(key, 10497 - 1000, 33648 * 2, 10497);
      if (wrap != 10497 && wrap != 33071 && wrap != 33648) {
        sampler.fail(key, "is not a wrap mode of glTF", "use 10497, 33071 or 33648");
      }
    }
  }
}

void check_node_transform(const JsonObject& node) {
  if (node.has("matrix")) {
    if (node.has("translation") || node.has("rotation") || node.has("scale")) {
      node.fail("matrix", "stands beside translation, rotation or scale", "keep one of the two");
    }
    const std::vector<double> m = node.numbers("matrix", 16, -kLargestTransform, kLargestTransform);
    // Column major: the last row is 3, 7, 11, 15. Anything but 0 0 0 1 is a projection,
    // which no ray can follow.
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
      node.fail("matrix", "is not affine (its last row is not 0 0 0 1)", "export the model again");
    }
  }
  if (node.has("translation")) node.numbers("translation", 3, -kLargestTransform, kLargestTransform);
  if (node.has("scale")) node.numbers("scale", 3, -kLargestTransform, kLargestTransform);
  if (node.has("rotation")) {
    const std::vector<double> q = node.numbers("rotation", 4, -1, 1);
    if (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] < 1e-6) {
      node.fail("rotation", "is a quaternion of length zero", "write a unit quaternion x, y, z, w");
    }
  }
}

// The node graph must be a forest: each node has at most one parent, and no chain of
// parents returns to its start.
void check_nodes(const JsonObject& root, const Counts& counts) {
  const std::vector<JsonObject> nodes = root.objects("nodes");
  std::vector<std::int64_t> parent(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].text_or("name", "");
    check_node_transform(nodes[i]);
    check_index(nodes[i], "mesh", counts.meshes);
    check_index(nodes[i], "skin", counts.skins);
    for (const std::int64_t child : index_list(nodes[i], "children", counts.nodes)) {
      std::int64_t& owner = parent[static_cast<std::size_t>(child)];
      if (owner >= 0) {
        nodes[i].fail("children",
                      "names node " + std::to_string(child) + ", which already is a child of node " +
                          std::to_string(owner),
                      "give each node one parent");
      }
      owner = static_cast<std::int64_t>(i);
    }
  }

  // With one parent each, following parents from i ends at a root, or runs into i's own mark: a cycle.
  std::vector<std::size_t> mark(nodes.size(), nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    std::size_t at = i;
    while (mark[at] == nodes.size()) {
      mark[at] = i;
      if (parent[at] < 0) break;
      at = static_cast<std::size_t>(parent[at]);
      if (mark[at] == i) nodes[at].fail(nullptr, "is its own ancestor", "remove the cycle of nodes");
    }
  }

  for (const JsonObject& scene : root.objects("scenes")) {
    for (const std::int64_t index : index_list(scene, "nodes", counts.nodes)) {
      if (parent[static_cast<std::size_t>(index)] < 0) continue;
      scene.fail("nodes", "names node " + std::to_string(index) + ", which is the child of another node",
                 "name root nodes only");
    }
  }
}

}  // namespace

void check_gltf_references(const nlohmann::json& document, const std::filesystem::path& file) {
  const JsonObject root(document, file, "");
  const Counts counts{size_of(root, "accessors"), size_of(root, "meshes"), size_of(root, "materials"),
                      size_of(root, "textures"),  size_of(root, "images"), size_of(root, "samplers"),
                      size_of(root, "nodes"),     size_of(root, "skins")};
  check_meshes(root, counts);
  check_textures(root, counts);
  check_nodes(root, counts);
  check_index(root, "scene", size_of(root, "scenes"));
}

}  // namespace herr
