// Maps glTF materials to ours, and decodes the textures that they use, each once.
// Before: read_gltf. After: load_gltf. The mapping is explained in scenes/README.md.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scenes/gltf/gltf_model.h"
#include "scenes/gltf/texture_decoder.h"

namespace herr {

// Share of the mirror ray that a surface shows: smooth metals and smooth glass mirror, rough surfaces and
// other dielectrics do not.
float mirror_of(float metallic, float roughness, float transmission);

// Appends to scene.materials and scene.textures as materials are asked for. One per glTF file.
class MaterialBuilder {
 public:
  MaterialBuilder(const GltfModel& model, Scene& scene) : model_(model), scene_(scene) {}

  // Set of texture coordinates that a glTF material (-1 = the default one) reads, or -1 when it has no
  // texture.
  int uv_set(int material) const;
  // Index in scene.materials. Without `textured` the textures are left out: the primitive has no coordinates.
  std::uint32_t material(int material, bool textured);

 private:
  Material build(const GltfMaterial& from, bool textured);
  int texture(const GltfTextureUse& use, bool srgb, int uv_set, const std::string& material);
  const DecodedImage& decoded(int image);
  std::int64_t texture_bytes_left() const;
  void warn(const std::string& text);

  const GltfModel& model_;
  Scene& scene_;
  std::map<std::pair<int, bool>, std::uint32_t> materials_;
  std::map<std::array<int, 4>, int> textures_;  // image, srgb, wrap u, wrap v
  std::map<int, DecodedImage> decoded_;
};

}  // namespace herr
