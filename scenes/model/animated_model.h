// A glTF file of which something moves by itself: its node tree, the clips that move it, its skins, and what
// bends its meshes. Before: gltf/animations, gltf/deformations. After: model_pose evaluates it at a time.
// Source: glTF 2.0 sections 3.7.3 (skins), 3.7.2.2 (morph targets), 3.11 (animations), appendix C.
#pragma once

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

namespace herr {

enum class Interpolation : std::uint8_t { step, linear, cubic_spline };
enum class AnimatedValue : std::uint8_t { translation, rotation, scale, weights };

// One value of one node over time. Cubic splines hold in-tangent, value and out-tangent for each time.
struct AnimationChannel {
  int node = 0;
  AnimatedValue value = AnimatedValue::translation;
  Interpolation interpolation = Interpolation::linear;
  int components = 3;          // numbers of one value; of weights: how many there are
  std::vector<float> times_s;  // at least one, finite, growing, >= 0
  std::vector<float> values;   // finite
};

struct AnimationClip {
  std::string name;
  double length_s = 0;  // the last time of any channel
  std::vector<AnimationChannel> channels;
};

// Its own transform is either the matrix, or what the other three say.
struct ModelNode {
  std::string name;
  int parent = -1;
  bool has_matrix = false;
  glm::dmat4x3 parent_from_node{1.0};
  glm::dvec3 translation{0.0}, scale{1.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  std::vector<float> weights;  // of morph targets
};

struct ModelSkin {
  std::vector<int> joints;                    // nodes
  std::vector<glm::dmat4x3> joint_from_mesh;  // one for each (inverse bind matrices)
};

// Which clip plays and how: its time is offset + speed * session time, taken round its
// length, or held at its ends.
struct Playback {
  int clip = -1;  // -1: none
  double speed = 1, offset_s = 0;
  bool loop = true;
};

struct AnimatedModel {
  std::string name;
  std::vector<ModelNode> nodes;
  std::vector<int> order;  // every node once, parents first
  std::vector<AnimationClip> clips;
  std::vector<ModelSkin> skins;
  Playback playback;
};

// Added times its weight; each may be empty.
struct MorphTarget {
  std::vector<glm::vec3> positions, normals, tangents;
};

// How one mesh bends: morph targets first, then the skin.
struct MeshDeformation {
  std::uint32_t mesh = 0;  // index into Scene::meshes, whose arrays are the shape at time 0
  std::vector<glm::vec3> rest_positions, rest_normals;
  std::vector<glm::vec4> rest_tangents;  // empty where the mesh has none
  bool flat_normals = false;             // every triangle has three vertices of its own, and its own normal
  int model = 0, node = 0;               // of Scene::models: whose weights
  int skin = -1;                         // of that model
  // Per vertex, of a skin: joints and weights that sum to 1, as many as `influences`; vertex by vertex.
  int influences = 0;  // 0, 4 or 8
  std::vector<std::uint16_t> joints;
  std::vector<float> weights;
  std::vector<MorphTarget> targets;
};

// What a frame gives to one deformation.
struct DeformationPose {
  std::uint32_t version = 0;  // another number whenever the rest is another
  std::vector<std::array<float, 12>>
      joints;                  // columns of mesh_from_mesh_at_rest, 3 x 4, per joint of the skin
  std::vector<float> weights;  // of morph targets
};

}  // namespace herr
