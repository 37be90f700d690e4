#include "scenes/gltf/animated_models.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "scenes/animation/bend_mesh.h"
#include "scenes/gltf/file/accessor_reader.h"
#include "scenes/gltf/vertex_tangents.h"
#include "sessions/files/input_error.h"
#include "sessions/files/nearest_name.h"

namespace herr {
namespace {

[[noreturn]] void fail(const GltfModel& model, const std::string& what) {
  throw InputError(model.file, 0, what, "export the model again");
}

AnimationChannel channel_of(const GltfModel& model, const GltfChannel& from, const std::string& where) {
  AnimationChannel to;
  to.node = from.node;
  to.value = from.value;
  to.interpolation = from.interpolation;
  to.times_s = read_floats(model, from.input, 1);
  if (to.times_s.empty()) fail(model, where + " has no key");
  for (std::size_t i = 0; i < to.times_s.size(); ++i) {
    if (to.times_s[i] < 0 || (i > 0 && !(to.times_s[i] > to.times_s[i - 1])))
      fail(model, where + ": its times do not grow from 0");
  }
  const GltfNode& node = model.nodes[static_cast<std::size_t>(from.node)];
  const bool weights = from.value == AnimatedValue::weights;
  to.components = weights                                 ? static_cast<int>(node.weights.size())
                  : from.value == AnimatedValue::rotation ? 4
                                                          : 3;
  if (to.components == 0) fail(model, where + " moves the weights of a node without morph targets");
  const std::size_t values = to.times_s.size() * (from.interpolation == Interpolation::cubic_spline ? 3 : 1) *
                             (weights ? static_cast<std::size_t>(to.components) : 1);
  if (accessor_of(model, from.output).count != values) {
    fail(model, where + " has " + std::to_string(accessor_of(model, from.output).count) +
                    " values where its keys need " + std::to_string(values));
  }
  to.values = read_floats(model, from.output, weights ? 1 : to.components);
  return to;
}

AnimationClip clip_of(const GltfModel& model, std::size_t index) {
  const GltfAnimation& from = model.animations[index];
  AnimationClip clip{from.name, 0, {}};
  for (std::size_t i = 0; i < from.channels.size(); ++i) {
    const std::string where = "animations[" + std::to_string(index) + "] channel " + std::to_string(i);
    clip.channels.push_back(channel_of(model, from.channels[i], where));
    clip.length_s = std::max(clip.length_s, double{clip.channels.back().times_s.back()});
  }
  return clip;
}

// Index of the clip that is asked for, -1 where none plays.
int chosen_clip(const GltfModel& model, const PlaybackRequest& request) {
  const int count = static_cast<int>(model.animations.size());
  if (!request.play) return -1;
  if (request.name) {
    std::vector<std::string> names;
    for (int i = 0; i < count; ++i) {
      names.push_back(model.animations[static_cast<std::size_t>(i)].name);
      if (names.back() == *request.name) return i;
    }
    const std::string nearest = nearest_name(*request.name, names);
    throw InputError(model.file, 0, "has no animation \"" + printable(*request.name) + "\"",
                     names.empty()     ? "leave \"animation\" out"
                     : nearest.empty() ? "its first is \"" + printable(names.front()) + "\""
                                       : "the nearest is \"" + printable(nearest) + "\"");
  }
  const int number = request.number.value_or(0);
  if (number < count) return number;
  if (!request.number) return -1;
  throw InputError(model.file, 0,
                   "has " + std::to_string(count) + " animations, not number " + std::to_string(number),
                   "count from 0");
}

std::vector<int> parents_first(const GltfModel& model, std::vector<ModelNode>& nodes) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    for (const int child : model.nodes[i].children)
      nodes[static_cast<std::size_t>(child)].parent = static_cast<int>(i);
  }
  std::vector<int> order, open;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parent < 0) open.push_back(static_cast<int>(i));
  }
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    order.push_back(node);
    const std::vector<int>& children = model.nodes[static_cast<std::size_t>(node)].children;
    open.insert(open.end(), children.begin(), children.end());
  }
  return order;
}

ModelSkin skin_of(const GltfModel& model, const GltfSkin& from) {
  ModelSkin to{from.joints, std::vector<glm::dmat4x3>(from.joints.size(), glm::dmat4x3(1.0))};
  if (from.joints.empty() || from.joints.size() > 65535)
    fail(model, "has a skin without joints, or above 65535");
  if (from.inverse_bind < 0) return to;
  const std::vector<float> values = read_floats(model, from.inverse_bind, 16);
  if (values.size() < 16 * from.joints.size())
    fail(model, "has a skin with fewer inverse bind matrices than joints");
  for (std::size_t joint = 0; joint < from.joints.size(); ++joint) {
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row)
        to.joint_from_mesh[joint][column][row] =
            double{values[16 * joint + static_cast<std::size_t>(4 * column + row)]};
    }
  }
  return to;
}

// Joints and weights of the vertices that are kept; weights sum to 1.
void read_influences(const GltfModel& model, const GltfPrimitive& primitive, std::size_t joint_count,
                     const std::vector<std::uint32_t>& sources, MeshDeformation& to) {
  to.influences = primitive.joints[1] >= 0 ? 8 : 4;
  const auto width = static_cast<std::size_t>(to.influences);
  to.joints.assign(width * sources.size(), 0);
  to.weights.assign(width * sources.size(), 0.0f);
  const std::size_t vertices = accessor_of(model, primitive.position).count;
  for (std::size_t set = 0; set < width / 4; ++set) {
    const std::vector<float> joints = read_floats(model, primitive.joints[set], 4);
    const std::vector<float> weights = read_floats(model, primitive.weights[set], 4);
    if (joints.size() != 4 * vertices || weights.size() != 4 * vertices)
      fail(model, "has another count of JOINTS or WEIGHTS than of POSITION");
    for (std::size_t i = 0; i < sources.size(); ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t from = 4 * std::size_t{sources[i]} + k, at = width * i + 4 * set + k;
        const float joint = joints[from], weight = std::max(weights[from], 0.0f);
        if (weight > 0 && !(joint >= 0 && joint < static_cast<float>(joint_count)))
          fail(model, "names joint " + std::to_string(static_cast<std::int64_t>(joint)) + " of " +
                          std::to_string(joint_count) + " in JOINTS");
        to.joints[at] = weight > 0 ? static_cast<std::uint16_t>(joint) : std::uint16_t{0};
        to.weights[at] = weight;
      }
    }
  }
  for (std::size_t i = 0; i < sources.size(); ++i) {
    float* weights = &to.weights[width * i];
    double sum = 0;
    for (std::size_t k = 0; k < width; ++k) sum += double{weights[k]};
    if (!(sum > 0)) weights[0] = 1.0f;  // a vertex that nothing holds follows the first joint
    for (std::size_t k = 0; k < width && sum > 0; ++k)
      weights[k] = static_cast<float>(double{weights[k]} / sum);
  }
}

std::vector<glm::vec3> read_offsets(const GltfModel& model, int accessor, std::size_t vertices,
                                    const std::vector<std::uint32_t>& sources) {
  const std::vector<float> values = read_floats(model, accessor, 3);
  if (values.size() != 3 * vertices) fail(model, "has a morph target of another count than POSITION");
  std::vector<glm::vec3> offsets;
  for (const std::size_t i : sources)
    offsets.emplace_back(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  return offsets;
}

// Before anything is read: one accessor may stand for all of a small file's targets. `each`: vertices of one
// array, those that are decoded and those that are kept.
void charge(MeshBudget& budget, const GltfModel& model, const GltfPrimitive& primitive, bool skinned,
            std::size_t each) {
  std::size_t arrays = 3;  // the shape at rest
  if (skinned) arrays += primitive.joints[1] >= 0 ? 4 : 2;
  for (const GltfTarget& target : primitive.targets) {
    arrays += (target.position >= 0 ? 1u : 0u) + (target.normal >= 0 ? 1u : 0u) + 1u;  // 1: tangents
  }
  spend(budget.decoded_elements, arrays * each, model, "vertices that bend");
}

// What a morph target without tangents adds to them: those that its shape has at
// weight 1, less those at rest.
std::vector<glm::vec3> tangent_offsets(const MeshDeformation& rest, const MorphTarget& target,
                                       const TriangleMesh& mesh, int uv_set,
                                       const std::vector<glm::vec3>& at_rest) {
  MeshDeformation morph;
  morph.rest_positions = rest.rest_positions;
  morph.rest_normals = rest.rest_normals;
  morph.rest_tangents = rest.rest_tangents;
  morph.flat_normals = rest.flat_normals;
  morph.targets = {target};
  DeformationPose pose;
  pose.weights = {1.0f};
  TriangleMesh morphed = mesh;
  bend_mesh(morph, pose, morphed);
  std::vector<glm::vec3> offsets = tangent_directions(morphed, uv_set);
  for (std::size_t i = 0; i < offsets.size(); ++i) offsets[i] -= at_rest[i];
  return offsets;
}

}  // namespace

AnimatedModel animated_model(const GltfModel& model, const PlaybackRequest& request) {
  AnimatedModel to;
  to.name = model.file.filename().string();
  for (const GltfNode& node : model.nodes) {
    to.nodes.push_back({node.name, -1, node.has_matrix, node.parent_from_node, node.translation, node.scale,
                        node.rotation, node.weights});
  }
  to.order = parents_first(model, to.nodes);
  for (const GltfSkin& skin : model.skins) to.skins.push_back(skin_of(model, skin));
  const int chosen = chosen_clip(model, request);
  for (std::size_t i = 0; i < model.animations.size(); ++i) {
    AnimationClip clip = clip_of(model, i);
    if (static_cast<int>(i) == chosen && !clip.channels.empty()) to.clips.push_back(std::move(clip));
  }
  to.playback = {to.clips.empty() ? -1 : 0, request.speed, request.offset_s, request.loop};
  return to;
}

std::vector<bool> moved_nodes(const AnimatedModel& model) {
  std::vector<bool> moved(model.nodes.size());
  for (const AnimationClip& clip : model.clips) {
    for (const AnimationChannel& channel : clip.channels) {
      if (channel.value != AnimatedValue::weights) moved[static_cast<std::size_t>(channel.node)] = true;
    }
  }
  for (const int node : model.order) {
    const int parent = model.nodes[static_cast<std::size_t>(node)].parent;
    if (parent >= 0 && moved[static_cast<std::size_t>(parent)]) moved[static_cast<std::size_t>(node)] = true;
  }
  return moved;
}

std::optional<MeshDeformation> mesh_deformation(const GltfModel& model, const BuiltPrimitive& built, int node,
                                                const TriangleMesh& mesh, MeshBudget& budget) {
  const GltfPrimitive& primitive = *built.from;
  const std::vector<std::uint32_t>& sources = built.sources;
  const int skin = model.nodes[static_cast<std::size_t>(node)].skin;
  const bool skinned = skin >= 0 && primitive.joints[0] >= 0;
  if (!skinned && primitive.targets.empty()) return std::nullopt;
  const std::size_t vertices = accessor_of(model, primitive.position).count;
  MeshDeformation to;
  to.node = node;
  to.rest_positions = mesh.positions;
  to.rest_normals = mesh.normals;
  to.rest_tangents = mesh.tangents;
  to.flat_normals = primitive.normal < 0;
  charge(budget, model, primitive, skinned, sources.size() + vertices);
  if (skinned) {
    to.skin = skin;
    read_influences(model, primitive, model.skins[static_cast<std::size_t>(skin)].joints.size(), sources, to);
  }
  std::vector<glm::vec3> directions;  // of tangents at rest
  for (const GltfTarget& target : primitive.targets) {
    MorphTarget& made = to.targets.emplace_back();
    const auto read = [&](int accessor) { return read_offsets(model, accessor, vertices, sources); };
    if (target.position >= 0) made.positions = read(target.position);
    if (target.normal >= 0 && !to.flat_normals) made.normals = read(target.normal);
    if (mesh.tangents.empty()) continue;
    if (target.tangent >= 0 && !built.made_tangents) {
      made.tangents = read(target.tangent);
    } else if (!mesh.uvs.empty()) {
      if (directions.empty()) directions = tangent_directions(mesh, built.tangent_uv_set);
      made.tangents = tangent_offsets(to, made, mesh, built.tangent_uv_set, directions);
    }
  }
  return to;
}

}  // namespace herr
