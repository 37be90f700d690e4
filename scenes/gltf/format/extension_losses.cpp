#include "scenes/gltf/format/extension_losses.h"

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "scenes/gltf/format/known_extensions.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

using nlohmann::json;

constexpr std::size_t kNamedPlaces = 3;

// Arrays of a document whose entries a reader knows by name, and the word for one of them.
constexpr std::pair<const char*, const char*> kNamed[] = {
    {"materials", "material"}, {"nodes", "node"},           {"meshes", "mesh"},
    {"textures", "texture"},   {"animations", "animation"}, {"images", "image"},
    {"cameras", "camera"},     {"skins", "skin"},           {"scenes", "scene"}};

class Uses {
 public:
  // Every "extensions" of `value` and below it, but for what stands inside extensions that are not read.
  void collect(const json& value, const std::string& place) {
    if (value.is_array()) {
      for (const json& item : value) {
        if (item.is_structured()) collect(item, place);
      }
    }
    if (!value.is_object()) return;
    for (const auto& [key, member] : value.items()) {
      if (key == "extensions" && member.is_object()) {
        take(value, member, place);
      } else if (key != "extras" && member.is_structured()) {
        collect(member, place);
      }
    }
  }

  void take(const json& owner, const json& extensions, const std::string& place) {
    for (const auto& [name, content] : extensions.items()) {
      if (is_read_extension(name)) {
        collect(content, place);
        continue;
      }
      named_.insert(name);
      std::vector<std::string>& places = places_[{name, extension_loss(name, owner.contains("source"))}];
      if (places.empty() || places.back() != place) places.push_back(place);
    }
  }

  bool name(const std::string& extension) const { return named_.count(extension) != 0; }

  std::vector<std::string> lines() const {
    std::vector<std::string> lines;
    for (const auto& [use, places] : places_) {
      std::string text = "extension " + printable(use.first) + " is not read: ";
      for (std::size_t i = 0; i < places.size() && i < kNamedPlaces; ++i)
        text += (i > 0 ? ", " : "") + places[i];
      if (places.size() > kNamedPlaces)
        text += " and " + std::to_string(places.size() - kNamedPlaces) + " more";
      lines.push_back(text + ": " + use.second);
    }
    return lines;
  }

 private:
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> places_;  // by name and loss
  std::set<std::string> named_;
};

std::string place_of(const std::string& array, const json& item, std::size_t index) {
  for (const auto& [key, word] : kNamed) {
    const bool named = array == key && item.is_object() && item.contains("name") &&
                       item["name"].is_string() && !item["name"].get_ref<const std::string&>().empty();
    if (named) return std::string(word) + " \"" + printable(item["name"].get<std::string>()) + "\"";
  }
  return printable(array) + "[" + std::to_string(index) + "]";
}

// Looks that a viewer could choose between; the default one is what the primitives say themselves.
void add_variants(const json& document, std::vector<std::string>& lines) {
  const json::json_pointer place("/extensions/KHR_materials_variants/variants");
  if (!document.contains(place) || !document.at(place).is_array()) return;
  std::string names;
  std::size_t count = 0;
  for (const json& variant : document.at(place)) {
    if (!variant.is_object() || !variant.contains("name") || !variant["name"].is_string()) continue;
    if (count++ < kNamedPlaces)
      names += (count > 1 ? ", \"" : " \"") + printable(variant["name"].get<std::string>()) + '"';
  }
  if (count == 0) return;
  if (count > kNamedPlaces) names += " and " + std::to_string(count - kNamedPlaces) + " more";
  lines.push_back("its variants" + names + " are left out: shown in its default look");
}

}  // namespace

std::vector<std::string> extension_losses(const json& document, const std::vector<std::string>& used) {
  Uses uses;
  for (const auto& [key, value] : document.items()) {
    if (key == "extensions" && value.is_object()) {
      uses.take(document, value, "the file");
    } else if (key != "extras" && value.is_array()) {
      for (std::size_t i = 0; i < value.size(); ++i) uses.collect(value[i], place_of(key, value[i], i));
    } else if (key != "extras" && value.is_object()) {
      uses.collect(value, key);
    }
  }
  std::vector<std::string> lines = uses.lines();
  for (const std::string& name : std::set<std::string>(used.begin(), used.end())) {
    if (is_read_extension(name) || uses.name(name)) continue;
    lines.push_back("extension " + printable(name) + " is not read: " +
                    (is_known_extension(name) ? "nothing in the file uses it" : extension_loss(name, false)));
  }
  add_variants(document, lines);
  return lines;
}

}  // namespace herr
