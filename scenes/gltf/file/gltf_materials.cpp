#include "scenes/gltf/file/gltf_materials.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

constexpr double kStrongestFactor = 1e6;  // emissive strength, specular colour
constexpr double kLargestScale = 1e6;     // of a normal texture
constexpr double kLargestIndex = 100;     // of refraction; the extension sets no limit, diamond has 2.4
constexpr double kLargestCutoff = 1e6;    // above 1 nothing of the surface is left, which is allowed

std::optional<JsonObject> part(const JsonObject& parent, const char* key) {
  if (!parent.has(key)) return std::nullopt;
  return parent.object(key);
}

std::optional<JsonObject> extension(const JsonObject& parent, const char* name) {
  const auto extensions = part(parent, "extensions");
  return extensions ? part(*extensions, name) : std::nullopt;
}

float factor(const JsonObject& object, const char* key, double highest, double fallback) {
  return static_cast<float>(object.number_or(key, 0, highest, fallback));
}

glm::vec3 colour(const JsonObject& object, const char* key, double highest, double fallback) {
  return glm::vec3(object.vec3_or(key, 0, highest, glm::dvec3(fallback)));
}

class MaterialReader {
 public:
  explicit MaterialReader(std::size_t textures) : textures_(static_cast<std::int64_t>(textures)) {}

  GltfMaterial read(const JsonObject& from) const {
    GltfMaterial to;
    to.name = from.text_or("name", "");
    to.emission = colour(from, "emissiveFactor", 1, 0);
    to.emission_texture = texture(from, "emissiveTexture");
    texture(from, "occlusionTexture");  // checked; our own ambient occlusion is traced
    to.normal_texture = texture(from, "normalTexture");
    if (to.normal_texture.texture >= 0) {
      to.normal_scale = static_cast<float>(
          from.object("normalTexture").number_or("scale", -kLargestScale, kLargestScale, 1));
    }
    to.double_sided = from.boolean_or("doubleSided", false);
    read_alpha(from, to);
    if (const auto pbr = part(from, "pbrMetallicRoughness")) read_metallic_roughness(*pbr, to);
    read_extensions(from, to);
    return to;
  }

 private:
  GltfTextureUse texture(const JsonObject& parent, const char* key) const {
    if (!parent.has(key)) return {};
    const JsonObject use = parent.object(key);
    return {static_cast<int>(use.integer("index", 0, textures_ - 1)), read_uv_source(use)};
  }

  static void read_alpha(const JsonObject& from, GltfMaterial& to) {
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

  void read_metallic_roughness(const JsonObject& from, GltfMaterial& to) const {
    if (from.has("baseColorFactor")) {
      const std::vector<double> rgba = from.numbers("baseColorFactor", 4, 0, 1);
      to.base_colour = glm::vec3(rgba[0], rgba[1], rgba[2]);
      to.alpha = static_cast<float>(rgba[3]);
    }
    to.metallic = factor(from, "metallicFactor", 1, 1);
    to.roughness = factor(from, "roughnessFactor", 1, 1);
    to.base_colour_texture = texture(from, "baseColorTexture");
    to.metallic_roughness_texture = texture(from, "metallicRoughnessTexture");
  }

  void read_extensions(const JsonObject& from, GltfMaterial& to) const {
    to.unlit = extension(from, "KHR_materials_unlit").has_value();
    if (const auto emissive = extension(from, "KHR_materials_emissive_strength")) {
      to.emission *= factor(*emissive, "emissiveStrength", kStrongestFactor, 1);
    }
    if (const auto transmission = extension(from, "KHR_materials_transmission")) {
      to.transmission = factor(*transmission, "transmissionFactor", 1, 0);
      to.transmission_texture = texture(*transmission, "transmissionTexture");
    }
    if (const auto index = extension(from, "KHR_materials_ior")) {
      to.refractive_index = factor(*index, "ior", kLargestIndex, 1.5);
      // 0 stands for a fully reflective surface; between 0 and 1 there is nothing.
      if (to.refractive_index > 0 && to.refractive_index < 1) {
        index->fail("ior", "lies between 0 and 1", "write 0, or 1 and above");
      }
    }
    if (const auto specular = extension(from, "KHR_materials_specular")) {
      to.specular = factor(*specular, "specularFactor", 1, 1);
      to.specular_colour = colour(*specular, "specularColorFactor", kStrongestFactor, 1);
      to.specular_texture = texture(*specular, "specularTexture");
      to.specular_colour_texture = texture(*specular, "specularColorTexture");
    }
  }

  std::int64_t textures_;
};

}  // namespace

void read_gltf_materials(const nlohmann::json& document, const std::filesystem::path& file,
                         GltfModel& model) {
  const JsonObject root(document, file, "");
  const MaterialReader reader(model.textures.size());
  for (const JsonObject& material : root.objects("materials")) {
    model.materials.push_back(reader.read(material));
  }
}

}  // namespace herr
