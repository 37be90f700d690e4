#include "scenes/gltf/file/gltf_lights.h"

#include <nlohmann/json.hpp>
#include <string>

#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

constexpr const char* kLightsExtension = "KHR_lights_punctual";
constexpr double kBrightestLight = 1e24, kBrightestColour = 1e9, kFarthestLight_m = 1e9;
constexpr double kHalfPi = 1.5707963267948966;

bool has_extension(const JsonObject& object) {
  return object.has("extensions") && object.object("extensions").has(kLightsExtension);
}

AreaLight read_light(const JsonObject& object, std::vector<std::string>& warnings) {
  AreaLight light;
  light.name = object.text_or("name", "");
  const std::string type = object.text("type");
  if (type == "spot") {
    light.kind = LightKind::spot;
  } else if (type == "directional") {
    light.kind = LightKind::sun;
  } else if (type != "point") {
    warnings.push_back("light \"" + printable(light.name) + "\" is of the unknown type \"" + printable(type) +
                       "\"; it does not shine");
    return light;
  }
  const auto intensity = static_cast<float>(object.number_or("intensity", 0, kBrightestLight, 1));
  light.intensity_w_sr = glm::vec3(object.vec3_or("color", 0, kBrightestColour, glm::dvec3(1.0))) * intensity;
  light.range_m = light.kind == LightKind::sun ? 0 : object.number_or("range", 0, kFarthestLight_m, 0);
  if (light.kind != LightKind::spot) return light;
  const JsonObject cone = object.object("spot");
  light.outer_cone_rad = cone.number_or("outerConeAngle", 1e-3, kHalfPi, 0.7853981633974483);
  light.inner_cone_rad = cone.number_or("innerConeAngle", 0, kHalfPi, 0);
  if (light.inner_cone_rad >= light.outer_cone_rad) {
    cone.fail("innerConeAngle", "is not below outerConeAngle", "export the model again");
  }
  return light;
}

}  // namespace

void read_gltf_lights(const nlohmann::json& document, const std::filesystem::path& file, GltfModel& model) {
  const JsonObject root(document, file, "");
  if (has_extension(root)) {
    for (const JsonObject& light : root.object("extensions").object(kLightsExtension).objects("lights")) {
      model.lights.push_back(read_light(light, model.warnings));
    }
  }
  const std::vector<JsonObject> nodes = root.objects("nodes");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!has_extension(nodes[i])) continue;
    const JsonObject use = nodes[i].object("extensions").object(kLightsExtension);
    const auto lights = static_cast<std::int64_t>(model.lights.size());
    if (lights == 0) use.fail("light", "names a light, and the file has none", "export the model again");
    model.nodes[i].light = static_cast<int>(use.integer("light", 0, lights - 1));
  }
}

}  // namespace herr
