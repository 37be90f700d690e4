#include "sessions/files/nearest_name.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace herr {
namespace {

constexpr std::size_t kShortestBeginning = 3;

constexpr const char* kQuaternion = "a quaternion x, y, z, w";
constexpr const char* kRadiantIntensity = "watts per steradian, red, green, blue";

// The first line that fits counts: keys of materials and places stand before those of lights.
constexpr KeySynonym kSynonyms[]{{"color", "base_colour", ""},
                                 {"colour", "base_colour", ""},
                                 {"color", "intensity_w_sr", kRadiantIntensity},
                                 {"colour", "intensity_w_sr", kRadiantIntensity},
                                 {"albedo", "base_colour", ""},
                                 {"diffuse", "base_colour", ""},
                                 {"baseColor", "base_colour", ""},
                                 {"baseColorFactor", "base_colour", ""},
                                 {"emissive", "emission", "radiance"},
                                 {"glow", "emission", "radiance"},
                                 {"metalness", "metallic", ""},
                                 {"ior", "refractive_index", ""},
                                 {"reflectivity", "mirror", ""},
                                 {"reflection", "mirror", ""},
                                 {"opacity", "transmission", "1 lets all light pass"},
                                 {"rotation", "rotation_xyzw", kQuaternion},
                                 {"rotation", "orientation_xyzw", kQuaternion},
                                 {"orientation", "rotation_xyzw", kQuaternion},
                                 {"orientation", "orientation_xyzw", kQuaternion},
                                 {"quaternion", "rotation_xyzw", kQuaternion},
                                 {"quaternion", "orientation_xyzw", kQuaternion},
                                 {"euler", "rotation_xyzw", kQuaternion},
                                 {"rotation_deg", "rotation_xyzw", kQuaternion},
                                 {"rotate", "rotation_xyzw", kQuaternion},
                                 {"position", "centre", "metres"},
                                 {"position", "translation", "metres"},
                                 {"location", "centre", "metres"},
                                 {"location", "translation", "metres"},
                                 {"center", "centre", "metres"},
                                 {"center", "translation", "metres"},
                                 {"translation", "centre", "metres"},
                                 {"translation", "position", "metres"},
                                 {"translate", "translation", "metres"},
                                 {"intensity", "intensity_w_sr", kRadiantIntensity},
                                 {"intensity", "irradiance_w_m2", ""},
                                 {"power", "intensity_w_sr", kRadiantIntensity},
                                 {"strength", "intensity_w_sr", kRadiantIntensity},
                                 {"brightness", "intensity_w_sr", kRadiantIntensity},
                                 {"type", "kind", ""},
                                 {"target", "direction", "a vector"},
                                 {"half_size", "half_extents", "metres"},
                                 {"extents", "half_extents", "metres"},
                                 {"size", "half_extents", "half of it along each axis, metres"},
                                 {"dimensions", "size", "metres"},
                                 {"uri", "file", ""},
                                 {"url", "file", ""},
                                 {"src", "file", ""},
                                 {"path", "file", ""},
                                 {"filename", "file", ""},
                                 {"models", "gltf", ""},
                                 {"model", "gltf", ""},
                                 {"meshes", "gltf", ""},
                                 {"objects", "gltf", ""},
                                 {"sky", "environment", ""},
                                 {"background", "environment", ""},
                                 {"skybox", "environment_map", ""},
                                 {"hdri", "environment_map", ""},
                                 {"version", "format_version", ""}};

std::string_view without_dashes(std::string_view name) {
  const std::size_t first = name.find_first_not_of('-');
  return first == std::string_view::npos ? name : name.substr(first);
}

// Damerau's distance, of which each letter is in at most one exchange; three rows at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) next[j] = std::min(next[j], before[j - 2] + 1);
    }
    before.swap(row);
    row.swap(next);
  }
  return row.back();
}

const std::string* begun_by(std::string_view word, const std::vector<std::string>& known) {
  if (word.size() < kShortestBeginning) return nullptr;
  const std::string* shortest = nullptr;
  for (const std::string& name : known) {
    if (!without_dashes(name).starts_with(word)) continue;
    if (shortest == nullptr || name.size() < shortest->size()) shortest = &name;
  }
  return shortest;
}

}  // namespace

std::string nearest_name(std::string_view unknown, const std::vector<std::string>& known) {
  // Keys may be megabytes long; the names that matter are short.
  const std::string_view word = without_dashes(unknown.substr(0, 256));
  if (const std::string* begun = begun_by(word, known)) return *begun;
  std::string nearest;
  std::size_t least = static_cast<std::size_t>(-1);
  for (const std::string& name : known) {
    const std::string_view other = without_dashes(name);
    const std::size_t distance = edit_distance(word, other);
    const std::size_t most = std::max<std::size_t>(1, std::max(word.size(), other.size()) / 3);
    if (distance > most || distance >= word.size() || distance >= least) continue;
    least = distance;
    nearest = name;
  }
  return nearest;
}

const KeySynonym* key_synonym(std::string_view unknown, const std::vector<std::string>& known) {
  for (const KeySynonym& synonym : kSynonyms) {
    if (unknown == synonym.foreign && std::find(known.begin(), known.end(), synonym.known) != known.end())
      return &synonym;
  }
  return nullptr;
}

std::string key_remedy(std::string_view unknown, const std::vector<std::string>& known) {
  if (known.empty()) return "remove it";
  const auto guess = [](const std::string& name) { return "did you mean '" + name + "'"; };
  if (const KeySynonym* synonym = key_synonym(unknown, known)) {
    const std::string holds = synonym->holds;
    return guess(synonym->known) + (holds.empty() ? "" : " (" + holds + ")") + "?";
  }
  if (const std::string nearest = nearest_name(unknown, known); !nearest.empty()) return guess(nearest) + "?";
  std::string all;
  for (const std::string& name : known) all += (all.empty() ? "" : ", ") + name;
  return "known here: " + all;
}

}  // namespace herr
