// A glTF 2.0 file as plain structs: what the other stages of this folder read instead of tinygltf's classes.
// Before: read_gltf fills it, after gltf_checks has proved every index and extent. After: accessor_reader,
// material_builder, mesh_builder, node_flattener.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scenes/gltf/file/texture_transform.h"
#include "scenes/model/scene.h"

namespace herr {

struct GltfBufferView {
  int buffer = 0;
  std::size_t offset = 0, length = 0;
  std::size_t stride = 0;  // 0 = tightly packed
};

// GL's names of component types, as glTF uses them.
enum GltfComponent : int {
  kByte = 5120,
  kUByte = 5121,
  kShort = 5122,
  kUShort = 5123,
  kUInt = 5125,
  kFloat = 5126
};

struct GltfAccessor {
  int view = -1;  // -1: all zero
  std::size_t offset = 0, count = 0;
  int component_type = kFloat;
  int components = 1;  // 1 ... 16
  bool normalised = false;
  // Sparse: `sparse_count` elements replaced; 0 = none.
  std::size_t sparse_count = 0, sparse_index_offset = 0, sparse_value_offset = 0;
  int sparse_index_view = -1, sparse_value_view = -1, sparse_index_type = kUInt;
};

// A morph target: accessors of what is added, -1 = nothing.
struct GltfTarget {
  int position = -1, normal = -1, tangent = -1;
};

struct GltfPrimitive {
  int mode = 4;  // 0 points ... 4 triangles, 5 strip, 6 fan
  int indices = -1, material = -1;
  int position = -1, normal = -1, tangent = -1;
  std::vector<int> uv_sets;                            // accessor of TEXCOORD_n, -1 = absent
  int colour = -1;                                     // COLOR_0
  std::array<int, 2> joints{-1, -1}, weights{-1, -1};  // JOINTS_0 and _1, WEIGHTS_0 and _1
  std::vector<GltfTarget> targets;
};

struct GltfMesh {
  std::string name;
  std::vector<GltfPrimitive> primitives;
  std::vector<float> weights;  // of morph targets, where nodes name none
};

struct GltfSkin {
  std::vector<int> joints;  // nodes
  int inverse_bind = -1;    // accessor
};

struct GltfChannel {
  int node = 0;
  AnimatedValue value = AnimatedValue::translation;
  Interpolation interpolation = Interpolation::linear;
  int input = -1, output = -1;  // accessors
};

struct GltfAnimation {
  std::string name;
  std::vector<GltfChannel> channels;
};

struct GltfTextureUse {
  int texture = -1;
  UvSource coordinates;
};

struct GltfMaterial {
  std::string name;
  glm::vec3 base_colour{1.0f}, emission{0.0f};  // linear; emission includes its strength
  float metallic = 1.0f, roughness = 1.0f;
  float transmission = 0.0f, refractive_index = 1.5f;
  bool has_thickness = false;  // a body with something inside, not a thin wall
  float alpha = 1.0f, alpha_cutoff = 0.5f;
  AlphaMode alpha_mode = AlphaMode::opaque;
  bool double_sided = false, unlit = false;
  float specular = 1.0f, normal_scale = 1.0f;
  glm::vec3 specular_colour{1.0f};
  GltfTextureUse base_colour_texture, metallic_roughness_texture, emission_texture, specular_texture,
      specular_colour_texture, transmission_texture, normal_texture;
  float occlusion_strength = 1.0f;
  GltfTextureUse occlusion_texture;
  float coat = 0.0f, coat_roughness = 0.0f, coat_normal_scale = 1.0f;
  GltfTextureUse coat_texture, coat_roughness_texture, coat_normal_texture;
  glm::vec3 sheen_colour{0.0f};
  float sheen_roughness = 0.0f;
  GltfTextureUse sheen_colour_texture, sheen_roughness_texture;
  float anisotropy = 0.0f, anisotropy_rotation_rad = 0.0f;
  GltfTextureUse anisotropy_texture;
  Attenuation attenuation;  // of light inside; none where the file says that nothing is inside
  // KHR_materials_pbrSpecularGlossiness: glossiness in the specular colour texture's alpha, times
  // `glossiness`. Base colour is its diffuse colour, specular_colour all of F0 (refractive_index is 0),
  // metallic is 0.
  bool has_glossiness = false;
  float glossiness = 1.0f;
};

struct GltfTexture {
  int image = -1;  // -1: only an extension names the image
  TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
  bool nearest = false;  // magnification filter
};

// An image still encoded: in `view` when that is >= 0, else in `encoded`; when that is
// empty, `failure` says why.
struct GltfImage {
  std::string name;
  int view = -1;
  std::vector<unsigned char> encoded;
  std::exception_ptr failure;
};

// EXT_mesh_gpu_instancing: accessors of one transform per instance, -1 = absent; all absent = one instance.
struct GltfInstancing {
  int translation = -1, rotation = -1, scale = -1;
};

struct GltfNode {
  std::string name;
  int mesh = -1;
  int light = -1;
  std::vector<int> children;
  glm::dmat4x3 parent_from_node{1.0};
  GltfInstancing instancing;
  int skin = -1;
  bool has_matrix = false;  // else translation, rotation and scale
  glm::dvec3 translation{0.0}, scale{1.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  std::vector<float> weights;  // of morph targets
  bool visible = true;         // else nothing of it shows, nor of the nodes below
};

struct GltfModel {
  std::filesystem::path file;
  std::vector<std::vector<unsigned char>> buffers;
  std::vector<GltfBufferView> views;
  std::vector<GltfAccessor> accessors;
  std::vector<GltfMesh> meshes;
  std::vector<GltfMaterial> materials;
  std::vector<GltfTexture> textures;
  std::vector<GltfImage> images;
  std::vector<AreaLight> lights;  // at the origin, shining along -Z
  std::vector<GltfNode> nodes;
  std::vector<int> roots;  // of the scene to show
  std::vector<GltfSkin> skins;
  std::vector<GltfAnimation> animations;
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files;  // read, the glTF file first
};

inline const GltfAccessor& accessor_of(const GltfModel& model, int index) {
  return model.accessors[static_cast<std::size_t>(index)];
}

// "FILE: text" with control characters escaped, as Scene::warnings holds it.
std::string gltf_warning(const GltfModel& model, const std::string& text);

}  // namespace herr
