// Maps glTF materials to ours, and decodes the textures that they use, each once.
// Before: read_gltf. After: load_gltf. The mapping is explained in README.md of this folder.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "scenes/gltf/file/gltf_model.h"
#include "scenes/gltf/material_losses.h"
#include "scenes/gltf/texture_decoder.h"
#include "scenes/model/texture_pixels.h"

namespace herr {

// Appends to scene.materials and scene.textures as materials are asked for. One per glTF file. Where
// pixels are left out, only those that say whether a material mirrors are decoded.
class MaterialBuilder {
 public:
  MaterialBuilder(const GltfModel& model, Scene& scene, TexturePixels pixels)
      : model_(model), scene_(scene), pixels_(pixels) {}

  // The coordinates that the textures of a glTF material (-1 = the default one) read, each once, without
  // those of sets that `primitive` lacks. A mesh has them in this order.
  std::vector<UvSource> uv_sources(int material, const GltfPrimitive& primitive) const;
  // Does it read coordinates that are not among `sources`?
  bool lacks_coordinates(int material, const std::vector<UvSource>& sources) const;
  // Has it a normal texture or a stretched highlight, which need tangents?
  bool reads_tangents(int material) const;
  // Index in scene.materials, for a mesh that has `sources`; textures that read others are left out.
  std::uint32_t material(int material, const std::vector<UvSource>& sources);
  // After the last one: what pictures do not show of them, as warnings of the scene.
  void warn_of_losses();

 private:
  struct Key {
    int material;
    std::vector<int> sets;
    auto operator<=>(const Key&) const = default;
  };
  // rough_gloss: 1 - factor x alpha, which is made of a glossiness.
  enum class Values : std::uint8_t { linear, colour, covering_colour, rough_gloss };
  using Get = std::function<TextureSlot(const GltfTextureUse&, Values, float factor)>;
  Material build(const GltfMaterial& from, const std::vector<UvSource>& sources);
  void add_textures(const GltfMaterial& from, const Get& get, Material& to);
  static void add_lobes(const GltfMaterial& from, const Get& get, Material& to);
  TextureSlot slot(const GltfTextureUse& use, Values values, float factor,
                   const std::vector<UvSource>& sources, const std::string& material);
  int texture(const GltfTexture& from, Values values, float factor);
  ImageSize size_of(int image);
  const DecodedImage& decoded(int image);
  const std::vector<std::uint8_t>& pixels_of(int image);
  struct ChannelRange {
    float least, mean, largest;
  };
  ChannelRange range_of(const GltfTextureUse& use, std::size_t channel);
  EncodedImage encoded(int image) const;
  std::int64_t texture_bytes_left() const;
  void note_losses(const GltfMaterial& from, const Material& to);
  void warn(const std::string& text);

  const GltfModel& model_;
  Scene& scene_;
  TexturePixels pixels_;
  MaterialLosses losses_;
  std::map<Key, std::uint32_t> materials_;
  std::map<std::array<int, 6>, int> textures_;  // image, values, wrap u, wrap v, nearest, factor's bits
  std::map<int, DecodedImage> decoded_;         // without pixels where a texture holds them
  std::map<int, int> holders_;                  // by image: the texture of the scene that holds its pixels
};

}  // namespace herr
