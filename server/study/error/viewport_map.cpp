#include "server/study/error/viewport_map.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "sessions/format/covered_by_focus.h"

namespace herr {
namespace {

constexpr std::array<Band, kBands> kBandList{{{"0_5_deg", "0–5°", 0, 5},
                                              {"5_15_deg", "5–15°", 5, 15},
                                              {"15_30_deg", "15–30°", 15, 30},
                                              {"30_45_deg", "30–45°", 30, 45},
                                              {"45_180_deg", "45–180°", 45, 180},
                                              {"all", "all", 0, 180}}};

std::uint8_t band_at(double eccentricity_deg) {
  std::uint8_t band = 0;
  while (band + 2u < kBands && eccentricity_deg >= kBandList[band].to_deg) ++band;
  return band;
}

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

// Degrees from (a, c, -1) to (b, c, -1). A pixel's angle is small: its arc tangent is a short series.
double degrees_along(double a, double b, double c) {
  const double across = (b - a) * std::sqrt(1 + c * c), along = a * b + c * c + 1;
  if (!(across < 0.01 * along)) return glm::degrees(std::atan2(across, along));
  const double t = across / along, t2 = t * t;
  return glm::degrees(t * (1 - t2 * (1.0 / 3 - t2 * (1.0 / 5))));  // the rest: t^6 / 7 < 2e-13
}

}  // namespace

std::span<const Band, kBands> bands() {
  return kBandList;
}

ViewportMap viewport_map(const DisplayProfile& profile, std::size_t viewport, const glm::dvec3& gaze) {
  const Viewport& v = profile.viewports.at(viewport);
  const auto width = static_cast<std::size_t>(v.width_px), height = static_cast<std::size_t>(v.height_px);
  ViewportMap map;
  map.width_px = v.width_px;
  map.height_px = v.height_px;
  for (auto* values :
       {&map.eccentricity_deg, &map.solid_angle_sr, &map.degrees_per_column, &map.degrees_per_row})
    values->resize(width * height);
  map.band.resize(width * height);
  map.pixels_per_degree = v.width_px / glm::degrees(std::atan(v.tan_right) - std::atan(v.tan_left));
  const double column = (v.tan_right - v.tan_left) / v.width_px;
  const double row = (v.tan_up - v.tan_down) / v.height_px;
  for (std::size_t y = 0, i = 0; y < height; ++y) {
    const double tan_y = v.tan_up - (static_cast<double>(y) + 0.5) * row;
    for (std::size_t x = 0; x < width; ++x, ++i) {
      const double tan_x = v.tan_left + (static_cast<double>(x) + 0.5) * column;
      const glm::dvec3 direction{tan_x, tan_y, -1.0};
      const double eccentricity = degrees_between(gaze, direction);
      const double squared = glm::dot(direction, direction);
      map.eccentricity_deg[i] = static_cast<float>(eccentricity);
      map.solid_angle_sr[i] = static_cast<float>(column * row / (squared * std::sqrt(squared)));
      map.degrees_per_column[i] =
          static_cast<float>(degrees_along(tan_x - 0.5 * column, tan_x + 0.5 * column, tan_y));
      map.degrees_per_row[i] = static_cast<float>(degrees_along(tan_y - 0.5 * row, tan_y + 0.5 * row, tan_x));
      map.band[i] = covered_by_focus(profile, viewport, tan_x, tan_y) ? kNotSeen : band_at(eccentricity);
    }
  }
  return map;
}

}  // namespace herr
