#include "scenes/gltf/file/gltf_lights.h"

#include <nlohmann/json.hpp>
#include <string>

#include "scenes/gltf/format/rounded_number.h"
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

void read_cone(const JsonObject& cone, RoundedNumbers& rounded, std::vector<std::string>& warnings,
               AreaLight& light) {
  light.outer_cone_rad = rounded.number_or(cone, "outerConeAngle", 1e-3, kHalfPi, 0.7853981633974483);
  light.inner_cone_rad = rounded.number_or(cone, "innerConeAngle", 0, kHalfPi, 0);
  if (light.inner_cone_rad < light.outer_cone_rad) return;
  const std::string problem = "is " + shown_number(light.inner_cone_rad) + ", not below outerConeAngle, " +
                              shown_number(light.outer_cone_rad);
  // Exporters write two equal angles for a sharp edge, and round each by itself.
  if (light.inner_cone_rad > light.outer_cone_rad * (1 + kRounding)) {
    cone.fail("innerConeAngle", problem, "export the model again");
  }
  warnings.push_back("field " + printable(cone.where()) + ".innerConeAngle " + problem +
                     "; the edge of the light is a narrow ramp");
  light.inner_cone_rad = light.outer_cone_rad;
}

AreaLight read_light(const JsonObject& object, RoundedNumbers& rounded, std::vector<std::string>& warnings) {
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
  const auto intensity = static_cast<float>(rounded.number_or(object, "intensity", 0, kBrightestLight, 1));
  light.intensity_w_sr =
      glm::vec3(rounded.vec3_or(object, "color", 0, kBrightestColour, glm::dvec3(1.0))) * intensity;
  light.range_m =
      light.kind == LightKind::sun ? 0 : rounded.number_or(object, "range", 0, kFarthestLight_m, 0);
  if (light.kind == LightKind::spot) read_cone(object.object("spot"), rounded, warnings, light);
  return light;
}

}  // namespace

void read_gltf_lights(const nlohmann::json& document, const std::filesystem::path& file, GltfModel& model) {
  const JsonObject root(document, file, "");
  if (has_extension(root)) {
    RoundedNumbers rounded;
    for (const JsonObject& light : root.object("extensions").object(kLightsExtension).objects("lights")) {
      model.lights.push_back(read_light(light, rounded, model.warnings));
    }
    rounded.warn(model.warnings);
  }
  const std::vector<JsonObject> nodes = root.objects("nodes");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!has_extension(nodes[i])) continue;
    const JsonObject use = nodes[i].object("extensions").object(kLightsExtension);
    const auto lights = static_cast<std::int64_t>(model.lights.size());
    model.nodes[i].light = static_cast<int>(use.integer("light", 0, lights - 1));
  }
}

}  // namespace herr
