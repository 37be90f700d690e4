// References of what moves a model or of what is not drawn at all - skins, animations, morph
// targets, cameras, extensions that are ignored: a file in which they lead nowhere is damaged, so it
// is refused all the same.
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "scenes/gltf/file/gltf_checks.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

class FurtherChecks {
 public:
  explicit FurtherChecks(const JsonObject& root) : root_(root) {}

  void skins() const {
    for (const JsonObject& skin : root_.objects("skins")) {
      index(skin, "inverseBindMatrices", "accessors");
      index(skin, "skeleton", "nodes");
      indices(skin, "joints", "nodes");
    }
  }

  void animations() const {
    for (const JsonObject& animation : root_.objects("animations")) {
      const std::vector<JsonObject> samplers = animation.objects("samplers");
      for (const JsonObject& sampler : samplers) {
        index(sampler, "input", "accessors");
        index(sampler, "output", "accessors");
      }
      for (const JsonObject& channel : animation.objects("channels")) {
        if (channel.has("sampler")) {
          channel.integer("sampler", 0, static_cast<std::int64_t>(samplers.size()) - 1);
        }
        if (channel.has("target")) index(channel.object("target"), "node", "nodes");
      }
    }
  }

  void meshes() const {
    for (const JsonObject& mesh : root_.objects("meshes")) {
      for (const JsonObject& primitive : mesh.objects("primitives")) {
        const std::vector<JsonObject> targets = primitive.objects("targets");
        for (std::size_t i = 0; i < targets.size(); ++i) {
          for (const auto& member : primitive.value("targets")[i].items()) {
            index(targets[i], member.key().c_str(), "accessors");
          }
        }
        variants(primitive);
      }
    }
  }

  void nodes() const {
    for (const JsonObject& node : root_.objects("nodes")) index(node, "camera", "cameras");
  }

  // "source" of EXT_texture_webp and its like.
  void textures() const {
    for (const JsonObject& texture : root_.objects("textures")) {
      for_each_extension(texture, [&](const JsonObject& extension, const nlohmann::json&) {
        index(extension, "source", "images");
      });
    }
  }

  // Every "...Texture" of every extension of a material.
  void materials() const {
    for (const JsonObject& material : root_.objects("materials")) {
      for_each_extension(material, [&](const JsonObject& extension, const nlohmann::json& members) {
        for (const auto& [name, value] : members.items()) {
          constexpr std::string_view kEnd = "Texture";
          const bool is_use = name.size() > kEnd.size() && value.is_object() &&
                              name.compare(name.size() - kEnd.size(), kEnd.size(), kEnd) == 0;
          if (is_use) index(extension.object(name.c_str()), "index", "textures");
        }
      });
    }
  }

 private:
  std::int64_t count(const char* array) const {
    return root_.has(array) && root_.value(array).is_array()
               ? static_cast<std::int64_t>(root_.value(array).size())
               : 0;
  }

  void index(const JsonObject& object, const char* key, const char* array) const {
    if (object.has(key)) object.integer(key, 0, count(array) - 1);
  }

  void indices(const JsonObject& object, const char* key, const char* array) const {
    if (!object.has(key)) return;
    if (!object.value(key).is_array()) object.fail(key, "is not an array", "write an array of indices");
    for (const nlohmann::json& item : object.value(key)) {
      const bool there =
          item.is_number_unsigned() && item.get<std::uint64_t>() < static_cast<std::uint64_t>(count(array));
      if (!there) object.fail(key, "holds an index that does not exist", "export the model again");
    }
  }

  // KHR_materials_variants: which material a primitive has in which variant.
  void variants(const JsonObject& primitive) const {
    constexpr const char* kName = "KHR_materials_variants";
    if (!primitive.has("extensions") || !primitive.object("extensions").has(kName)) return;
    std::int64_t known = 0;
    if (root_.has("extensions") && root_.object("extensions").has(kName)) {
      known = static_cast<std::int64_t>(root_.object("extensions").object(kName).objects("variants").size());
    }
    for (const JsonObject& mapping : primitive.object("extensions").object(kName).objects("mappings")) {
      index(mapping, "material", "materials");
      if (!mapping.has("variants") || !mapping.value("variants").is_array()) continue;
      for (const nlohmann::json& variant : mapping.value("variants")) {
        const bool there =
            variant.is_number_unsigned() && variant.get<std::uint64_t>() < static_cast<std::uint64_t>(known);
        if (!there) mapping.fail("variants", "holds an index that does not exist", "export the model again");
      }
    }
  }

  template <typename Visit>
  static void for_each_extension(const JsonObject& object, const Visit& visit) {
    if (!object.has("extensions")) return;
    const JsonObject extensions = object.object("extensions");
    for (const auto& [name, value] : object.value("extensions").items()) {
      if (value.is_object()) visit(extensions.object(name.c_str()), value);
    }
  }

  const JsonObject& root_;
};

}  // namespace

void check_gltf_further_references(const nlohmann::json& document, const std::filesystem::path& file) {
  const JsonObject root(document, file, "");
  const FurtherChecks checks(root);
  checks.skins();
  checks.animations();
  checks.meshes();
  checks.nodes();
  checks.textures();
  checks.materials();
}

}  // namespace herr
