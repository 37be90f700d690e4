#include "scenes/gltf/file/texture_transform.h"

#include <cmath>

namespace herr {
namespace {

constexpr const char* kTransformExtension = "KHR_texture_transform";
constexpr int kLastSet = 31;
constexpr double kFarthest = 1e6;  // of offsets and scales: coordinates stay finite in float

glm::dvec2 pair_or(const JsonObject& object, const char* key, double fallback) {
  if (!object.has(key)) return glm::dvec2(fallback);
  const std::vector<double> pair = object.numbers(key, 2, -kFarthest, kFarthest);
  return {pair[0], pair[1]};
}

}  // namespace

bool UvSource::moves() const {
  return offset != glm::dvec2(0.0) || scale != glm::dvec2(1.0) || rotation_rad != 0;
}

glm::vec2 UvSource::apply(const glm::vec2& uv) const {
  if (!moves()) return uv;
  const glm::dvec2 p = scale * glm::dvec2(uv);
  const double c = std::cos(rotation_rad), s = std::sin(rotation_rad);
  return glm::vec2(glm::dvec2(c * p.x + s * p.y, c * p.y - s * p.x) + offset);
}

UvSource read_uv_source(const JsonObject& use) {
  UvSource source;
  source.set = static_cast<int>(use.integer_or("texCoord", 0, kLastSet, 0));
  if (!use.has("extensions") || !use.object("extensions").has(kTransformExtension)) return source;
  const JsonObject transform = use.object("extensions").object(kTransformExtension);
  source.set = static_cast<int>(transform.integer_or("texCoord", 0, kLastSet, source.set));
  source.offset = pair_or(transform, "offset", 0.0);
  source.scale = pair_or(transform, "scale", 1.0);
  source.rotation_rad = transform.number_or("rotation", -kFarthest, kFarthest, 0);
  return source;
}

}  // namespace herr
