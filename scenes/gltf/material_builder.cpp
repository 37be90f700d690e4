#include "scenes/gltf/material_builder.h"

#include <algorithm>
#include <utility>

#include "scenes/gltf/file/gltf_limits.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

const GltfMaterial kDefault{};

const GltfMaterial& material_of(const GltfModel& model, int index) {
  return index < 0 ? kDefault : model.materials[static_cast<std::size_t>(index)];
}

// Every texture that a material reads, base colour first: its coordinates become the mesh's first set.
std::array<const GltfTextureUse*, 7> texture_uses(const GltfMaterial& material) {
  return {&material.base_colour_texture, &material.metallic_roughness_texture,
          &material.emission_texture,    &material.normal_texture,
          &material.specular_texture,    &material.specular_colour_texture,
          &material.transmission_texture};
}

std::int64_t texture_bytes(const ImageSize& size) {
  return std::int64_t{4} * size.width_px * size.height_px;
}

}  // namespace

float mirror_of(float metallic, float roughness, float transmission) {
  // At roughness 0.35 a GGX lobe is some 14 degrees wide: a single mirror ray no longer stands for it.
  constexpr float kRoughest = 0.35f;
  const float clear = std::max(metallic, (1.0f - metallic) * transmission);
  return std::clamp(clear, 0.0f, 1.0f) * std::clamp((kRoughest - roughness) / kRoughest, 0.0f, 1.0f);
}

std::vector<UvSource> MaterialBuilder::uv_sources(int material, const GltfPrimitive& primitive) const {
  std::vector<UvSource> sources;
  for (const GltfTextureUse* use : texture_uses(material_of(model_, material))) {
    if (use->texture < 0) continue;
    if (static_cast<std::size_t>(use->coordinates.set) >= primitive.uv_sets.size()) continue;
    if (std::find(sources.begin(), sources.end(), use->coordinates) == sources.end()) {
      sources.push_back(use->coordinates);
    }
  }
  return sources;
}

bool MaterialBuilder::lacks_coordinates(int material, const std::vector<UvSource>& sources) const {
  for (const GltfTextureUse* use : texture_uses(material_of(model_, material))) {
    if (use->texture < 0) continue;
    if (std::find(sources.begin(), sources.end(), use->coordinates) == sources.end()) return true;
  }
  return false;
}

bool MaterialBuilder::reads_tangents(int material) const {
  const GltfMaterial& from = material_of(model_, material);
  return from.normal_texture.texture >= 0 && !from.unlit;
}

std::uint32_t MaterialBuilder::material(int material, const std::vector<UvSource>& sources, bool coloured) {
  // Transforms belong to the material: sets tell meshes of one material apart.
  Key key{material, {}, coloured};
  for (const UvSource& source : sources) key.sets.push_back(source.set);
  const auto [entry, added] = materials_.try_emplace(key, 0);
  if (added) {
    const Material built = build(material_of(model_, material), sources, coloured);
    entry->second = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back(built);
  }
  return entry->second;
}

Material MaterialBuilder::build(const GltfMaterial& from, const std::vector<UvSource>& sources,
                                bool coloured) {
  Material to;
  to.name = from.name;
  to.base_colour = from.base_colour;
  to.emission = from.emission;
  to.metallic = from.metallic;
  to.roughness = from.roughness;
  to.transmission = from.transmission;
  to.refractive_index = from.refractive_index > 0 ? from.refractive_index : 100.0f;  // 0: reflects everything
  to.alpha = from.alpha;
  to.alpha_mode = from.alpha_mode;
  to.alpha_cutoff = from.alpha_cutoff;
  to.double_sided = from.double_sided;
  to.specular = from.specular;
  to.specular_colour = from.specular_colour;
  to.normal_scale = from.normal_scale;
  const auto get = [&](const GltfTextureUse& use, Values values) {
    return slot(use, values, sources, from.name);
  };
  const bool covers = from.alpha_mode != AlphaMode::opaque;
  const TextureSlot base = get(from.base_colour_texture, covers ? Values::covering_colour : Values::colour);
  to.base_colour_texture = base.texture;
  to.base_colour_uv_set = base.uv_set;
  // An unlit surface shows its colour whatever the light: that is emission, unless the colour varies.
  if (from.unlit) {
    to.metallic = to.transmission = to.mirror = 0.0f;
    to.roughness = 1.0f;
    to.unlit = base.texture >= 0 || coloured;
    to.emission = to.unlit ? glm::vec3(0.0f) : to.base_colour;
    if (!to.unlit) to.base_colour = glm::vec3(0.0f);
    return to;
  }
  const TextureSlot rough = get(from.metallic_roughness_texture, Values::linear);
  to.metallic_roughness_texture = rough.texture;
  to.metallic_roughness_uv_set = rough.uv_set;
  if (to.emission != glm::vec3(0.0f)) to.emission_texture = get(from.emission_texture, Values::colour);
  to.normal_texture = get(from.normal_texture, Values::linear);
  to.specular_texture = get(from.specular_texture, Values::linear);
  to.specular_colour_texture = get(from.specular_colour_texture, Values::colour);
  if (to.transmission > 0) to.transmission_texture = get(from.transmission_texture, Values::linear);

  // The mirror share is one number per material: textures count with their mean.
  if (to.metallic <= 0 && to.transmission <= 0) return to;  // no mirror, whatever the textures hold
  const auto mean = [&](const TextureSlot& read, const GltfTextureUse& use, std::size_t channel) {
    return read.texture < 0 ? 1.0f : channel_mean(use, channel);
  };
  const GltfTextureUse& roughness = from.metallic_roughness_texture;
  to.mirror = mirror_of(to.metallic * mean(rough, roughness, 2), to.roughness * mean(rough, roughness, 1),
                        to.transmission * mean(to.transmission_texture, from.transmission_texture, 0));
  return to;
}

// Mean of one channel of a texture, 0 ... 1.
float MaterialBuilder::channel_mean(const GltfTextureUse& use, std::size_t channel) {
  const std::vector<std::uint8_t>& rgba =
      pixels_of(model_.textures[static_cast<std::size_t>(use.texture)].image);
  std::uint64_t sum = 0;
  for (std::size_t i = channel; i < rgba.size(); i += 4) sum += rgba[i];
  return static_cast<float>(static_cast<double>(sum) / (255.0 * 0.25 * static_cast<double>(rgba.size())));
}

TextureSlot MaterialBuilder::slot(const GltfTextureUse& use, Values values,
                                  const std::vector<UvSource>& sources, const std::string& material) {
  if (use.texture < 0) return {};
  const GltfTexture& from = model_.textures[static_cast<std::size_t>(use.texture)];
  if (from.image < 0) {
    warn("a texture of material \"" + printable(material) +
         "\" has no image that is supported; it is left out");
    return {};
  }
  // load_gltf warns of primitives without the coordinates.
  const auto source = std::find(sources.begin(), sources.end(), use.coordinates);
  if (source == sources.end()) return {};
  return {texture(from, values), static_cast<int>(source - sources.begin())};
}

int MaterialBuilder::texture(const GltfTexture& from, Values values) {
  const auto [entry, added] =
      textures_.try_emplace({from.image, static_cast<int>(values), static_cast<int>(from.wrap_u),
                             static_cast<int>(from.wrap_v), from.nearest ? 1 : 0},
                            -1);
  if (!added) return entry->second;
  const ImageSize size = size_of(from.image);
  if (texture_bytes(size) > texture_bytes_left()) {
    throw InputError(model_.file, 0, "has more than 1 GiB of textures", "shrink the textures of the model");
  }
  TextureImage to;
  to.name = model_.images[static_cast<std::size_t>(from.image)].name;
  to.width_px = size.width_px;
  to.height_px = size.height_px;
  to.srgb = values != Values::linear;
  to.covers = values == Values::covering_colour;
  to.wrap_u = from.wrap_u;
  to.wrap_v = from.wrap_v;
  to.nearest = from.nearest;
  entry->second = static_cast<int>(scene_.textures.size());
  if (pixels_ == TexturePixels::decoded) {
    // The first texture of an image keeps its pixels, for further ones and for means to read.
    const bool first = holders_.try_emplace(from.image, scene_.textures.size()).second;
    to.rgba = first ? std::move(decoded_.at(from.image).rgba) : pixels_of(from.image);
  }
  scene_.textures.push_back(std::move(to));
  return entry->second;
}

ImageSize MaterialBuilder::size_of(int index) {
  if (pixels_ == TexturePixels::left_out) return texture_size(encoded(index), texture_bytes_left());
  const DecodedImage& image = decoded(index);
  return {image.width_px, image.height_px};
}

const DecodedImage& MaterialBuilder::decoded(int index) {
  const auto [entry, added] = decoded_.try_emplace(index);
  if (added) entry->second = decode_image(encoded(index), texture_bytes_left());
  return entry->second;
}

const std::vector<std::uint8_t>& MaterialBuilder::pixels_of(int image) {
  const auto holder = holders_.find(image);
  return holder != holders_.end() ? scene_.textures[holder->second].rgba : decoded(image).rgba;
}

EncodedImage MaterialBuilder::encoded(int index) const {
  const GltfImage& image = model_.images[static_cast<std::size_t>(index)];
  if (image.failure) std::rethrow_exception(image.failure);
  const unsigned char* bytes = image.encoded.data();
  std::size_t size = image.encoded.size();
  if (image.view >= 0) {
    const GltfBufferView& view = model_.views[static_cast<std::size_t>(image.view)];
    bytes = model_.buffers[static_cast<std::size_t>(view.buffer)].data() + view.offset;
    size = view.length;
  }
  return {bytes, size, model_.file, image.name};
}

std::int64_t MaterialBuilder::texture_bytes_left() const {
  std::int64_t left = kMaxTextureBytes;
  for (const TextureImage& texture : scene_.textures)
    left -= texture_bytes({texture.width_px, texture.height_px});
  return left;
}

void MaterialBuilder::warn(const std::string& text) {
  scene_.warnings.push_back(gltf_warning(model_, text));
}

}  // namespace herr
