#include "scenes/gltf/file/gltf_materials.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenes/gltf/format/known_extensions.h"
#include "scenes/gltf/format/rounded_number.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

constexpr double kStrongestFactor = 1e6;  // emissive strength, specular colour
constexpr double kLargestScale = 1e6;     // of a normal texture
constexpr double kLargestIndex = 100;     // of refraction; the extension sets no limit, diamond has 2.4
constexpr double kLargestCutoff = 1e6;    // above 1 nothing of the surface is left, which is allowed
constexpr double kLargestAngle = 1e6;     // radians
constexpr double kSmallestDistance = 1e-12, kLargestDistance = 1e12;  // metres, inside a body
constexpr double kAnyDistance = std::numeric_limits<double>::max();

std::optional<JsonObject> part(const JsonObject& parent, const char* key) {
  if (!parent.has(key)) return std::nullopt;
  return parent.object(key);
}

std::optional<JsonObject> extension(const JsonObject& parent, const char* name) {
  const auto extensions = part(parent, "extensions");
  return extensions ? part(*extensions, name) : std::nullopt;
}

class MaterialReader {
 public:
  MaterialReader(const nlohmann::json& document, std::size_t textures, std::vector<std::string>& warnings)
      : document_(document), textures_(static_cast<std::int64_t>(textures)), warnings_(warnings) {}

  GltfMaterial read(const JsonObject& from) {
    GltfMaterial to;
    to.name = from.text_or("name", "");
    // Above 1 before there was KHR_materials_emissive_strength.
    to.emission =
        glm::vec3(rounded_.vec3_or(from, "emissiveFactor", 0, 1, glm::dvec3(0.0), OutOfRange::clamped_above));
    to.emission_texture = texture(from, "emissiveTexture");
    to.occlusion_texture = texture(from, "occlusionTexture");
    if (to.occlusion_texture.texture >= 0)
      to.occlusion_strength = factor(from.object("occlusionTexture"), "strength", 1, 1, OutOfRange::clamped);
    to.normal_texture = texture(from, "normalTexture");
    to.normal_scale = normal_scale(from, "normalTexture");
    to.double_sided = from.boolean_or("doubleSided", false);
    read_alpha(from, to);
    if (const auto pbr = part(from, "pbrMetallicRoughness")) read_metallic_roughness(*pbr, to);
    to.unlit = extension(from, "KHR_materials_unlit").has_value();
    read_emission_and_passing(from, to);
    read_specular(from, to);
    read_further_lobes(from, to);
    read_if_sound(from, "KHR_materials_pbrSpecularGlossiness", to, [&](const JsonObject& old) {
      const bool stands_alone =
          !from.has("pbrMetallicRoughness") || from.value("pbrMetallicRoughness").empty();
      read_specular_glossiness(old, stands_alone, to);
    });
    return to;
  }

  // Of all materials read.
  void warn_of_rounding() const { rounded_.warn(warnings_); }

 private:
  // Extensions that few readers know: a broken one that is not required is passed over, with a warning.
  template <typename Read>
  void read_if_sound(const JsonObject& from, const char* name, GltfMaterial& to, const Read& read) {
    const GltfMaterial before = to;
    try {
      if (const auto found = extension(from, name)) read(*found);
    } catch (const InputError& error) {
      if (requires_extension(document_, name)) throw;
      to = before;
      warnings_.push_back(error.problem() + "; the material is shown without " + name);
    }
  }

  float factor(const JsonObject& object, const char* key, double highest, double fallback,
               OutOfRange beyond = OutOfRange::refused) {
    return static_cast<float>(rounded_.number_or(object, key, 0, highest, fallback, beyond));
  }

  glm::vec3 colour(const JsonObject& object, const char* key, double highest, double fallback,
                   OutOfRange beyond = OutOfRange::refused) {
    return glm::vec3(rounded_.vec3_or(object, key, 0, highest, glm::dvec3(fallback), beyond));
  }

  GltfTextureUse texture(const JsonObject& parent, const char* key) const {
    if (!parent.has(key)) return {};
    const JsonObject use = parent.object(key);
    return {static_cast<int>(use.integer("index", 0, textures_ - 1)), read_uv_source(use)};
  }

  static float normal_scale(const JsonObject& parent, const char* key) {
    if (!parent.has(key)) return 1.0f;
    return static_cast<float>(parent.object(key).number_or("scale", -kLargestScale, kLargestScale, 1));
  }

  void read_alpha(const JsonObject& from, GltfMaterial& to) {
    const std::string mode = from.text_or("alphaMode", "OPAQUE");
    to.alpha_cutoff = factor(from, "alphaCutoff", kLargestCutoff, 0.5);
    if (mode == "MASK") {
      to.alpha_mode = AlphaMode::mask;
    } else if (mode == "BLEND") {
      to.alpha_mode = AlphaMode::blend;
    } else if (mode != "OPAQUE") {
      from.fail("alphaMode", "is \"" + printable(mode) + "\"", "write OPAQUE, MASK or BLEND");
    }
  }

  void read_base_colour(const JsonObject& from, const char* key, OutOfRange beyond, GltfMaterial& to) {
    if (!from.has(key)) return;
    const std::vector<double> rgba = rounded_.numbers(from, key, 4, 0, 1, beyond);
    to.base_colour = glm::vec3(rgba[0], rgba[1], rgba[2]);
    to.alpha = static_cast<float>(rgba[3]);
  }

  void read_metallic_roughness(const JsonObject& from, GltfMaterial& to) {
    read_base_colour(from, "baseColorFactor", OutOfRange::refused, to);
    to.metallic = factor(from, "metallicFactor", 1, 1);
    to.roughness = factor(from, "roughnessFactor", 1, 1);
    to.base_colour_texture = texture(from, "baseColorTexture");
    to.metallic_roughness_texture = texture(from, "metallicRoughnessTexture");
  }

  void read_emission_and_passing(const JsonObject& from, GltfMaterial& to) {
    if (const auto emissive = extension(from, "KHR_materials_emissive_strength")) {
      to.emission *= factor(*emissive, "emissiveStrength", kStrongestFactor, 1);
    }
    if (const auto transmission = extension(from, "KHR_materials_transmission")) {
      to.transmission = factor(*transmission, "transmissionFactor", 1, 0);
      to.transmission_texture = texture(*transmission, "transmissionTexture");
    }
    read_if_sound(from, "KHR_materials_volume", to, [&](const JsonObject& volume) {
      texture(volume, "thicknessTexture");  // checked; what light meets inside is traced
      const float thickness = factor(volume, "thicknessFactor", kLargestDistance, 0, OutOfRange::clamped);
      Attenuation inside;
      inside.colour = colour(volume, "attenuationColor", 1, 1, OutOfRange::clamped);
      read_distance(volume, inside);
      if (!(thickness > 0)) return;  // a thin wall, with nothing inside
      to.has_thickness = true;
      to.attenuation = inside;
    });
    if (const auto index = extension(from, "KHR_materials_ior")) to.refractive_index = index_of(*index);
  }

  // 0 stands for a fully reflective surface; between 0 and 1 there is nothing.
  float index_of(const JsonObject& from) {
    const double index = rounded_.number_or(from, "ior", 0, kLargestIndex, 1.5);
    if (!(index > 0 && index < 1)) return static_cast<float>(index);
    if (1 - index <= kRounding)
      return static_cast<float>(rounded_.number_or(from, "ior", 1, kLargestIndex, 1));
    from.fail("ior", "is " + shown_number(index) + ", between 0 and 1", "write 0, or 1 and above");
  }

  // Writers that know no infinity write 0.
  void read_distance(const JsonObject& volume, Attenuation& inside) {
    if (!volume.has("attenuationDistance")) return;
    const double distance_m = volume.number("attenuationDistance", -kAnyDistance, kAnyDistance);
    if (distance_m > kLargestDistance) return;  // as far as no distance at all
    if (distance_m >= kSmallestDistance) {
      inside.distance_m = static_cast<float>(distance_m);
    } else {
      warnings_.push_back("field " + printable(volume.where()) + ".attenuationDistance is " +
                          shown_number(distance_m) + "; nothing is taken from light inside");
    }
  }

  void read_specular(const JsonObject& from, GltfMaterial& to) {
    if (const auto specular = extension(from, "KHR_materials_specular")) {
      to.specular = factor(*specular, "specularFactor", 1, 1);
      to.specular_colour = colour(*specular, "specularColorFactor", kStrongestFactor, 1);
      to.specular_texture = texture(*specular, "specularTexture");
      to.specular_colour_texture = texture(*specular, "specularColorTexture");
    }
  }

  void read_further_lobes(const JsonObject& from, GltfMaterial& to) {
    read_if_sound(from, "KHR_materials_clearcoat", to, [&](const JsonObject& coat) {
      to.coat = factor(coat, "clearcoatFactor", 1, 0, OutOfRange::clamped);
      to.coat_roughness = factor(coat, "clearcoatRoughnessFactor", 1, 0, OutOfRange::clamped);
      to.coat_texture = texture(coat, "clearcoatTexture");
      to.coat_roughness_texture = texture(coat, "clearcoatRoughnessTexture");
      to.coat_normal_texture = texture(coat, "clearcoatNormalTexture");
      to.coat_normal_scale = normal_scale(coat, "clearcoatNormalTexture");
    });
    read_if_sound(from, "KHR_materials_sheen", to, [&](const JsonObject& sheen) {
      to.sheen_colour = colour(sheen, "sheenColorFactor", 1, 0, OutOfRange::clamped);
      to.sheen_roughness = factor(sheen, "sheenRoughnessFactor", 1, 0, OutOfRange::clamped);
      to.sheen_colour_texture = texture(sheen, "sheenColorTexture");
      to.sheen_roughness_texture = texture(sheen, "sheenRoughnessTexture");
    });
    read_if_sound(from, "KHR_materials_anisotropy", to, [&](const JsonObject& stretched) {
      to.anisotropy = factor(stretched, "anisotropyStrength", 1, 0, OutOfRange::clamped);
      to.anisotropy_rotation_rad = static_cast<float>(rounded_.number_or(
          stretched, "anisotropyRotation", -kLargestAngle, kLargestAngle, 0, OutOfRange::clamped));
      to.anisotropy_texture = texture(stretched, "anisotropyTexture");
    });
  }

  // Checked wherever it stands, used where nothing else says what the surface is made of.
  void read_specular_glossiness(const JsonObject& from, bool stands_alone, GltfMaterial& to) {
    GltfMaterial old = to;
    read_base_colour(from, "diffuseFactor", OutOfRange::clamped, old);
    old.base_colour_texture = texture(from, "diffuseTexture");
    old.metallic = 0.0f;
    old.has_glossiness = true;
    old.glossiness = factor(from, "glossinessFactor", 1, 1, OutOfRange::clamped);
    old.refractive_index = 0.0f;
    old.specular = 1.0f;
    old.specular_texture = {};
    old.specular_colour = colour(from, "specularFactor", 1, 1, OutOfRange::clamped);
    old.specular_colour_texture = texture(from, "specularGlossinessTexture");
    if (stands_alone) to = old;
  }

  const nlohmann::json& document_;
  std::int64_t textures_;
  std::vector<std::string>& warnings_;
  RoundedNumbers rounded_;
};

}  // namespace

void read_gltf_materials(const nlohmann::json& document, const std::filesystem::path& file,
                         GltfModel& model) {
  const JsonObject root(document, file, "");
  MaterialReader reader(document, model.textures.size(), model.warnings);
  for (const JsonObject& material : root.objects("materials")) {
    model.materials.push_back(reader.read(material));
  }
  reader.warn_of_rounding();
}

}  // namespace herr
