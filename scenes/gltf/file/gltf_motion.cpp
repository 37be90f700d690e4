#include "scenes/gltf/file/gltf_motion.h"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

#include "scenes/gltf/file/gltf_limits.h"
#include "scenes/gltf/format/known_extensions.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

constexpr std::size_t kMaxTargets = 256;  // models of faces have about fifty

int index_or_none(const JsonObject& object, const char* key) {
  return static_cast<int>(object.integer_or(key, 0, 1 << 30, -1));
}

std::vector<float> weights_of(const JsonObject& object) {
  std::vector<float> weights;
  if (!object.has("weights")) return weights;
  const nlohmann::json& list = object.value("weights");
  if (!list.is_array() || list.size() > kMaxTargets)
    object.fail("weights", "is not an array of at most 256 numbers", "export the model again");
  for (const double weight : object.numbers("weights", list.size(), -kLargestTransform, kLargestTransform))
    weights.push_back(static_cast<float>(weight));
  return weights;
}

void read_primitive(const JsonObject& from, GltfPrimitive& to) {
  const JsonObject attributes = from.object("attributes");
  constexpr const char* kJoints[2] = {"JOINTS_0", "JOINTS_1"};
  constexpr const char* kWeights[2] = {"WEIGHTS_0", "WEIGHTS_1"};
  for (std::size_t set = 0; set < 2; ++set) {
    to.joints[set] = index_or_none(attributes, kJoints[set]);
    to.weights[set] = index_or_none(attributes, kWeights[set]);
    if ((to.joints[set] < 0) != (to.weights[set] < 0)) {
      attributes.fail(to.joints[set] < 0 ? kWeights[set] : kJoints[set], "has no counterpart",
                      "give each JOINTS its WEIGHTS");
    }
  }
  const std::vector<JsonObject> targets = from.objects("targets");
  if (targets.size() > kMaxTargets) from.fail("targets", "has more than 256 morph targets", "leave some out");
  for (const JsonObject& target : targets)
    to.targets.push_back({index_or_none(target, "POSITION"), index_or_none(target, "NORMAL"),
                          index_or_none(target, "TANGENT")});
}

// Attributes of a primitive and of its morph targets that glTF has a meaning for and no picture shows.
std::set<std::string> attributes_left_out(const JsonObject& from) {
  std::set<std::string> names;
  for (const auto& [name, accessor] : from.value("attributes").items()) {
    const bool influence = name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
    if (influence && !name.ends_with("_0") && !name.ends_with("_1")) names.insert(name);
  }
  if (!from.has("targets")) return names;
  for (const nlohmann::json& target : from.value("targets")) {
    for (const auto& [name, accessor] : target.items()) {
      if (name.starts_with("TEXCOORD_") || name.starts_with("COLOR_"))
        names.insert(name + " of morph targets");
    }
  }
  return names;
}

void read_meshes(const JsonObject& root, GltfModel& model) {
  const std::vector<JsonObject> meshes = root.objects("meshes");
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    GltfMesh& mesh = model.meshes[i];
    mesh.weights = weights_of(meshes[i]);
    const std::vector<JsonObject> primitives = meshes[i].objects("primitives");
    std::set<std::string> left_out;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      read_primitive(primitives[p], mesh.primitives[p]);
      left_out.merge(attributes_left_out(primitives[p]));
      // Weights are of the mesh: its primitives must agree on how many there are.
      if (mesh.primitives[p].targets.size() != mesh.primitives[0].targets.size()) {
        primitives[p].fail("targets", "has another number of morph targets than the first primitive",
                           "export the model again");
      }
    }
    if (!primitives.empty()) mesh.weights.resize(mesh.primitives[0].targets.size(), 0.0f);
    for (const std::string& name : left_out)
      model.warnings.push_back("mesh \"" + printable(mesh.name) + "\": " + printable(name) + " is left out");
  }
}

void read_nodes(const JsonObject& root, GltfModel& model) {
  const std::vector<JsonObject> nodes = root.objects("nodes");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    GltfNode& node = model.nodes[i];
    node.skin = index_or_none(nodes[i], "skin");
    node.has_matrix = nodes[i].has("matrix");
    node.translation =
        nodes[i].vec3_or("translation", -kLargestTransform, kLargestTransform, glm::dvec3(0.0));
    node.scale = nodes[i].vec3_or("scale", -kLargestTransform, kLargestTransform, glm::dvec3(1.0));
    if (nodes[i].has("rotation")) {
      const std::vector<double> q = nodes[i].numbers("rotation", 4, -1, 1);
      node.rotation = glm::normalize(glm::dquat(q[3], q[0], q[1], q[2]));
    }
    if (node.mesh < 0) continue;
    const std::vector<float>& resting = model.meshes[static_cast<std::size_t>(node.mesh)].weights;
    node.weights = weights_of(nodes[i]);
    if (node.weights.empty()) node.weights = resting;
    if (node.weights.size() != resting.size()) {
      nodes[i].fail("weights", "is not one number for each morph target of its mesh",
                    "export the model again");
    }
  }
}

// None: a path of an extension, which is left out.
std::optional<AnimatedValue> value_of(const JsonObject& target) {
  const std::string path = target.text("path");
  if (path == "translation") return AnimatedValue::translation;
  if (path == "rotation") return AnimatedValue::rotation;
  if (path == "scale") return AnimatedValue::scale;
  if (path == "weights") return AnimatedValue::weights;
  if (path == "pointer") return std::nullopt;  // KHR_animation_pointer
  target.fail("path", "is none of glTF's", "write translation, rotation, scale or weights");
}

Interpolation interpolation_of(const JsonObject& sampler) {
  const std::string name = sampler.text_or("interpolation", "LINEAR");
  if (name == "LINEAR") return Interpolation::linear;
  if (name == "STEP") return Interpolation::step;
  if (name == "CUBICSPLINE") return Interpolation::cubic_spline;
  sampler.fail("interpolation", "is none of glTF's", "write LINEAR, STEP or CUBICSPLINE");
}

void read_animations(const JsonObject& root, GltfModel& model) {
  bool left_out = false;
  for (const JsonObject& animation : root.objects("animations")) {
    GltfAnimation& to = model.animations.emplace_back();
    to.name = animation.text_or("name", "");
    const std::vector<JsonObject> samplers = animation.objects("samplers");
    for (const JsonObject& channel : animation.objects("channels")) {
      const JsonObject target = channel.object("target");
      const auto value = value_of(target);
      if (!value || !target.has("node")) {
        left_out = true;
        continue;
      }
      const JsonObject& sampler = samplers.at(
          static_cast<std::size_t>(channel.integer("sampler", 0, std::int64_t(samplers.size()) - 1)));
      const auto accessors = static_cast<std::int64_t>(model.accessors.size());
      GltfChannel& made = to.channels.emplace_back();
      made.node = index_or_none(target, "node");
      made.value = *value;
      made.interpolation = interpolation_of(sampler);
      made.input = static_cast<int>(sampler.integer("input", 0, accessors - 1));
      made.output = static_cast<int>(sampler.integer("output", 0, accessors - 1));
      const GltfNode& node = model.nodes[static_cast<std::size_t>(made.node)];
      if (node.has_matrix && made.value != AnimatedValue::weights) {
        target.fail("node", "names a node that stands by a matrix, which cannot be animated",
                    "write its translation, rotation and scale");
      }
    }
  }
  if (left_out) model.warnings.push_back("channels of animations that move no node are left out");
}

}  // namespace

void read_gltf_motion(const nlohmann::json& document, const std::filesystem::path& file, GltfModel& model) {
  const JsonObject root(document, file, "");
  read_meshes(root, model);
  read_nodes(root, model);
  for (const JsonObject& skin : root.objects("skins")) {
    GltfSkin& to = model.skins.emplace_back();
    for (const nlohmann::json& joint : skin.value("joints")) to.joints.push_back(joint.get<int>());
    to.inverse_bind = index_or_none(skin, "inverseBindMatrices");
  }
  read_animations(root, model);
}

void read_gltf_visibility(const nlohmann::json& document, const std::filesystem::path& file,
                          GltfModel& model) {
  constexpr const char* kName = "KHR_node_visibility";
  const std::vector<JsonObject> nodes = JsonObject(document, file, "").objects("nodes");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i].has("extensions") || !nodes[i].object("extensions").has(kName)) continue;
    try {
      model.nodes[i].visible = nodes[i].object("extensions").object(kName).boolean_or("visible", true);
    } catch (const InputError& error) {
      if (requires_extension(document, kName)) throw;
      model.warnings.push_back(error.problem() + "; the node is shown");
    }
  }
}

}  // namespace herr
