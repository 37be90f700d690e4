#include "sessions/import/rows/gaze_direction.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace herr {
namespace {

constexpr double kWidestTangentRad = 1.55;  // 88.8 degrees

}  // namespace

std::optional<glm::dvec3> direction_from_tangents(double x, double y) {
  const double widest = std::tan(kWidestTangentRad);
  if (!(std::abs(x) < widest && std::abs(y) < widest)) return std::nullopt;
  return glm::normalize(glm::dvec3(x, y, 1));
}

std::optional<glm::dvec3> direction_from_angles(AngleKind kind, double azimuth_rad, double elevation_rad) {
  if (kind == AngleKind::tangents) {
    if (!(std::abs(azimuth_rad) < kWidestTangentRad && std::abs(elevation_rad) < kWidestTangentRad))
      return std::nullopt;
    return direction_from_tangents(std::tan(azimuth_rad), std::tan(elevation_rad));
  }
  constexpr double kRounding = 1e-3;  // 180 degrees as 3.142
  if (!(std::abs(azimuth_rad) <= 2 * std::numbers::pi + kRounding &&
        std::abs(elevation_rad) <= std::numbers::pi + kRounding))
    return std::nullopt;
  const double sin_az = std::sin(azimuth_rad), cos_az = std::cos(azimuth_rad);
  const double sin_el = std::sin(elevation_rad), cos_el = std::cos(elevation_rad);
  if (kind == AngleKind::spherical) return glm::dvec3(cos_el * sin_az, sin_el, cos_el * cos_az);
  return glm::dvec3(sin_az, cos_az * sin_el, cos_az * cos_el);
}

}  // namespace herr
