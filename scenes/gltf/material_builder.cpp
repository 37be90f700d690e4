#include "scenes/gltf/material_builder.h"

#include <algorithm>

#include "scenes/gltf/gltf_limits.h"
#include "sessions/input_error.h"

namespace herr {
namespace {

const GltfMaterial kDefault{};

const GltfMaterial& material_of(const GltfModel& model, int index) {
  return index < 0 ? kDefault : model.materials[static_cast<std::size_t>(index)];
}

// The texture that decides which coordinates a material reads; others with different ones are left out.
int uv_set_of(const GltfMaterial& material) {
  if (material.base_colour_texture.texture >= 0) return material.base_colour_texture.uv_set;
  if (material.metallic_roughness_texture.texture >= 0) return material.metallic_roughness_texture.uv_set;
  return -1;
}

// Mean of one channel, 0 ... 1.
float channel_mean(const TextureImage& texture, std::size_t channel) {
  std::uint64_t sum = 0;
  for (std::size_t i = channel; i < texture.rgba.size(); i += 4) sum += texture.rgba[i];
  return static_cast<float>(static_cast<double>(sum) /
                            (255.0 * 0.25 * static_cast<double>(texture.rgba.size())));
}

}  // namespace

float mirror_of(float metallic, float roughness, float transmission) {
  // At roughness 0.35 a GGX lobe is some 14 degrees wide: a single mirror ray no longer stands for it.
  constexpr float kRoughest = 0.35f;
  const float clear = std::max(metallic, (1.0f - metallic) * transmission);
  return std::clamp(clear, 0.0f, 1.0f) * std::clamp((kRoughest - roughness) / kRoughest, 0.0f, 1.0f);
}

int MaterialBuilder::uv_set(int material) const {
  return uv_set_of(material_of(model_, material));
}

std::uint32_t MaterialBuilder::material(int material, bool textured) {
  const auto [entry, added] = materials_.try_emplace({material, textured}, 0);
  if (added) {
    const Material built = build(material_of(model_, material), textured);
    entry->second = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back(built);
  }
  return entry->second;
}

Material MaterialBuilder::build(const GltfMaterial& from, bool textured) {
  Material to;
  to.name = from.name;
  to.base_colour = from.base_colour;
  to.emission = from.emission;
  to.metallic = from.metallic;
  to.roughness = from.roughness;
  to.transmission = from.transmission;
  to.refractive_index = from.refractive_index > 0 ? from.refractive_index : 100.0f;  // 0: reflects everything
  if (textured) {
    const int set = uv_set_of(from);
    to.base_colour_texture = texture(from.base_colour_texture, true, set, from.name);
    to.metallic_roughness_texture = texture(from.metallic_roughness_texture, false, set, from.name);
  }

  // The mirror share is one number per material: textures count with their mean.
  float metallic = to.metallic, roughness = to.roughness;
  if (to.metallic_roughness_texture >= 0) {
    const TextureImage& image = scene_.textures[static_cast<std::size_t>(to.metallic_roughness_texture)];
    roughness *= channel_mean(image, 1);
    metallic *= channel_mean(image, 2);
  }
  to.mirror = mirror_of(metallic, roughness, to.transmission);

  // An unlit surface shows its colour whatever the light: that is emission. With a texture it stays lit.
  if (from.unlit && to.base_colour_texture < 0) {
    to.emission = to.base_colour;
    to.base_colour = glm::vec3(0.0f);
    to.metallic = 0.0f;
    to.roughness = 1.0f;
    to.mirror = 0.0f;
  } else if (from.unlit) {
    warn("material \"" + printable(from.name) + "\" is unlit with a texture; it is drawn lit");
  }
  return to;
}

int MaterialBuilder::texture(const GltfTextureUse& use, bool srgb, int uv_set, const std::string& material) {
  if (use.texture < 0) return -1;
  const GltfTexture& from = model_.textures[static_cast<std::size_t>(use.texture)];
  const std::string owner = "a texture of material \"" + printable(material) + "\"";
  if (from.image < 0) {
    warn(owner + " has no image that is supported; it is left out");
    return -1;
  }
  if (use.uv_set != uv_set) {
    warn(owner + " reads a second set of coordinates; it is left out");
    return -1;
  }
  const auto [entry, added] = textures_.try_emplace(
      {from.image, srgb ? 1 : 0, static_cast<int>(from.wrap_u), static_cast<int>(from.wrap_v)}, -1);
  if (!added) return entry->second;
  const DecodedImage& image = decoded(from.image);
  if (static_cast<std::int64_t>(image.rgba.size()) > texture_bytes_left()) {
    throw InputError(model_.file, 0, "has more than 1 GiB of textures", "shrink the textures of the model");
  }
  TextureImage to;
  to.name = model_.images[static_cast<std::size_t>(from.image)].name;
  to.width_px = image.width_px;
  to.height_px = image.height_px;
  to.srgb = srgb;
  to.wrap_u = from.wrap_u;
  to.wrap_v = from.wrap_v;
  to.rgba = image.rgba;
  entry->second = static_cast<int>(scene_.textures.size());
  scene_.textures.push_back(std::move(to));
  return entry->second;
}

const DecodedImage& MaterialBuilder::decoded(int index) {
  const auto [entry, added] = decoded_.try_emplace(index);
  if (!added) return entry->second;
  const GltfImage& image = model_.images[static_cast<std::size_t>(index)];
  if (image.failure) std::rethrow_exception(image.failure);
  const unsigned char* bytes = image.encoded.data();
  std::size_t size = image.encoded.size();
  if (image.view >= 0) {
    const GltfBufferView& view = model_.views[static_cast<std::size_t>(image.view)];
    bytes = model_.buffers[static_cast<std::size_t>(view.buffer)].data() + view.offset;
    size = view.length;
  }
  entry->second = decode_image(bytes, size, texture_bytes_left(), model_.file, image.name);
  return entry->second;
}

std::int64_t MaterialBuilder::texture_bytes_left() const {
  std::int64_t left = kMaxTextureBytes;
  for (const TextureImage& texture : scene_.textures) left -= static_cast<std::int64_t>(texture.rgba.size());
  return left;
}

void MaterialBuilder::warn(const std::string& text) {
  scene_.warnings.push_back(gltf_warning(model_, text));
}

}  // namespace herr
