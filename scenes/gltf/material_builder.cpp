#include "scenes/gltf/material_builder.h"

#include <algorithm>
#include <bit>
#include <cmath>
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
std::vector<const GltfTextureUse*> texture_uses(const GltfMaterial& material) {
  std::vector<const GltfTextureUse*> uses{
      &material.base_colour_texture,  &material.metallic_roughness_texture, &material.emission_texture,
      &material.normal_texture,       &material.specular_texture,           &material.specular_colour_texture,
      &material.transmission_texture, &material.occlusion_texture};
  if (material.coat > 0) {
    uses.insert(uses.end(),
                {&material.coat_texture, &material.coat_roughness_texture, &material.coat_normal_texture});
  }
  if (material.sheen_colour != glm::vec3(0.0f))
    uses.insert(uses.end(), {&material.sheen_colour_texture, &material.sheen_roughness_texture});
  if (material.anisotropy > 0) uses.push_back(&material.anisotropy_texture);
  std::erase_if(uses, [](const GltfTextureUse* use) { return use->texture < 0; });
  return uses;
}

// Glossiness in alpha -> roughness in green, as a metallic-roughness texture has it.
void make_rough(float glossiness, std::vector<std::uint8_t>& rgba) {
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    const float rough = 255.0f - glossiness * static_cast<float>(rgba[i + 3]);
    rgba[i] = rgba[i + 2] = rgba[i + 3] = 255;
    rgba[i + 1] = static_cast<std::uint8_t>(std::lround(rough));
  }
}

std::int64_t texture_bytes(const ImageSize& size) {
  return std::int64_t{4} * size.width_px * size.height_px;
}

}  // namespace

std::vector<UvSource> MaterialBuilder::uv_sources(int material, const GltfPrimitive& primitive) const {
  std::vector<UvSource> sources;
  const auto add = [&](const UvSource& source) {
    if (static_cast<std::size_t>(source.set) >= primitive.uv_sets.size()) return;
    if (std::find(sources.begin(), sources.end(), source) == sources.end()) sources.push_back(source);
  };
  const GltfMaterial& from = material_of(model_, material);
  for (const GltfTextureUse* use : texture_uses(from)) add(use->coordinates);
  // Tangents that are made follow coordinates even where no texture reads them.
  if (sources.empty() && reads_tangents(material) && primitive.tangent < 0) add({});
  return sources;
}

bool MaterialBuilder::lacks_coordinates(int material, const std::vector<UvSource>& sources) const {
  for (const GltfTextureUse* use : texture_uses(material_of(model_, material))) {
    if (std::find(sources.begin(), sources.end(), use->coordinates) == sources.end()) return true;
  }
  return false;
}

bool MaterialBuilder::reads_tangents(int material) const {
  const GltfMaterial& from = material_of(model_, material);
  if (from.unlit) return false;
  return from.normal_texture.texture >= 0 || from.anisotropy > 0 ||
         (from.coat > 0 && from.coat_normal_texture.texture >= 0);
}

std::uint32_t MaterialBuilder::material(int material, const std::vector<UvSource>& sources) {
  // Transforms belong to the material: sets tell meshes of one material apart.
  Key key{material, {}};
  for (const UvSource& source : sources) key.sets.push_back(source.set);
  const auto [entry, added] = materials_.try_emplace(key, 0);
  if (added) {
    const Material built = build(material_of(model_, material), sources);
    entry->second = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back(built);
  }
  return entry->second;
}

Material MaterialBuilder::build(const GltfMaterial& from, const std::vector<UvSource>& sources) {
  Material to;
  to.name = from.name;
  to.base_colour = from.base_colour;
  to.alpha = from.alpha;
  to.alpha_mode = from.alpha_mode;
  to.alpha_cutoff = from.alpha_cutoff;
  to.double_sided = from.double_sided;
  const Get get = [&](const GltfTextureUse& use, Values values, float factor) {
    return slot(use, values, factor, sources, from.name);
  };
  const bool covers = from.alpha_mode != AlphaMode::opaque;
  const TextureSlot base =
      get(from.base_colour_texture, covers ? Values::covering_colour : Values::colour, 1);
  to.base_colour_texture = base.texture;
  to.base_colour_uv_set = base.uv_set;
  // An unlit surface shows its colour whatever the light.
  to.unlit = from.unlit;
  if (from.unlit) {
    to.roughness = 1.0f;
    return to;
  }
  to.emission = from.emission;
  to.metallic = from.metallic;
  to.specular = from.specular;
  to.specular_colour = from.specular_colour;
  to.normal_scale = from.normal_scale;
  to.refractive_index = from.refractive_index;
  to.transmission = from.transmission;
  to.attenuation = from.attenuation;
  if (from.refractive_index <= 0 && from.transmission > 0) {
    warn("material \"" + printable(from.name) + "\" has the index 0 of a mirror: nothing passes it");
    to.transmission = 0.0f;
  }
  add_textures(from, get, to);
  add_lobes(from, get, to);
  note_losses(from, to);
  return to;
}

void MaterialBuilder::add_textures(const GltfMaterial& from, const Get& get, Material& to) {
  const TextureSlot rough = from.has_glossiness
                                ? get(from.specular_colour_texture, Values::rough_gloss, from.glossiness)
                                : get(from.metallic_roughness_texture, Values::linear, 1);
  to.metallic_roughness_texture = rough.texture;
  to.metallic_roughness_uv_set = rough.uv_set;
  to.roughness = from.roughness;
  if (from.has_glossiness) to.roughness = rough.texture >= 0 ? 1.0f : 1.0f - from.glossiness;
  if (rough.texture >= 0) {
    to.smoothest_texel = from.has_glossiness
                             ? 1.0f - from.glossiness * range_of(from.specular_colour_texture, 3).largest
                             : range_of(from.metallic_roughness_texture, 1).least;
  }
  if (to.emission != glm::vec3(0.0f)) to.emission_texture = get(from.emission_texture, Values::colour, 1);
  to.normal_texture = get(from.normal_texture, Values::linear, 1);
  to.specular_texture = get(from.specular_texture, Values::linear, 1);
  to.specular_colour_texture = get(from.specular_colour_texture, Values::colour, 1);
  if (to.transmission > 0) to.transmission_texture = get(from.transmission_texture, Values::linear, 1);
  to.occlusion_strength = from.occlusion_strength;
  if (to.occlusion_strength > 0) to.occlusion_texture = get(from.occlusion_texture, Values::linear, 1);
}

void MaterialBuilder::add_lobes(const GltfMaterial& from, const Get& get, Material& to) {
  if (from.coat > 0) {
    to.clearcoat = {from.coat,
                    from.coat_roughness,
                    from.coat_normal_scale,
                    get(from.coat_texture, Values::linear, 1),
                    get(from.coat_roughness_texture, Values::linear, 1),
                    get(from.coat_normal_texture, Values::linear, 1)};
  }
  if (from.sheen_colour != glm::vec3(0.0f)) {
    to.sheen = {from.sheen_colour, from.sheen_roughness, get(from.sheen_colour_texture, Values::colour, 1),
                get(from.sheen_roughness_texture, Values::linear, 1)};
  }
  if (from.anisotropy > 0) {
    to.anisotropy = {from.anisotropy, from.anisotropy_rotation_rad,
                     get(from.anisotropy_texture, Values::linear, 1)};
  }
}

void MaterialBuilder::note_losses(const GltfMaterial& from, const Material& to) {
  if (to.transmission <= 0 && from.coat <= 0 && from.sheen_colour == glm::vec3(0.0f)) return;
  const auto mean = [&](float factor, int texture, const GltfTextureUse& use) {
    return texture < 0 ? factor : factor * range_of(use, 1).mean;
  };
  MeanRoughness rough{to.roughness, mean(from.coat_roughness, to.clearcoat.roughness_texture.texture,
                                         from.coat_roughness_texture)};
  if (!from.has_glossiness && to.transmission > 0)
    rough.surface = mean(to.roughness, to.metallic_roughness_texture, from.metallic_roughness_texture);
  losses_.add(from, rough);
}

// One channel of a texture, 0 ... 1.
MaterialBuilder::ChannelRange MaterialBuilder::range_of(const GltfTextureUse& use, std::size_t channel) {
  const std::vector<std::uint8_t>& rgba =
      pixels_of(model_.textures[static_cast<std::size_t>(use.texture)].image);
  std::uint8_t least = 255, largest = 0;
  std::uint64_t sum = 0;
  for (std::size_t i = channel; i < rgba.size(); i += 4) {
    least = std::min(least, rgba[i]);
    largest = std::max(largest, rgba[i]);
    sum += rgba[i];
  }
  const double mean = static_cast<double>(sum) / (0.25 * static_cast<double>(rgba.size()));
  return {static_cast<float>(least) / 255.0f, static_cast<float>(mean / 255.0),
          static_cast<float>(largest) / 255.0f};
}

TextureSlot MaterialBuilder::slot(const GltfTextureUse& use, Values values, float factor,
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
  return {texture(from, values, factor), static_cast<int>(source - sources.begin())};
}

int MaterialBuilder::texture(const GltfTexture& from, Values values, float factor) {
  const auto [entry, added] =
      textures_.try_emplace({from.image, static_cast<int>(values), static_cast<int>(from.wrap_u),
                             static_cast<int>(from.wrap_v), from.nearest ? 1 : 0, std::bit_cast<int>(factor)},
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
  to.srgb = values == Values::colour || values == Values::covering_colour;
  to.covers = values == Values::covering_colour;
  to.wrap_u = from.wrap_u;
  to.wrap_v = from.wrap_v;
  to.nearest = from.nearest;
  entry->second = static_cast<int>(scene_.textures.size());
  if (pixels_ == TexturePixels::decoded) {
    // The first texture that shows an image as it is keeps its pixels, for further ones and for means to
    // read.
    const bool keeps =
        values != Values::rough_gloss && holders_.try_emplace(from.image, entry->second).second;
    to.rgba = keeps ? std::move(decoded_.at(from.image).rgba) : pixels_of(from.image);
  }
  if (values == Values::rough_gloss) make_rough(factor, to.rgba);
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
  return holder != holders_.end() ? scene_.textures[static_cast<std::size_t>(holder->second)].rgba
                                  : decoded(image).rgba;
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

void MaterialBuilder::warn_of_losses() {
  for (const std::string& line : losses_.lines()) warn(line);
}

void MaterialBuilder::warn(const std::string& text) {
  scene_.warnings.push_back(gltf_warning(model_, text));
}

}  // namespace herr
