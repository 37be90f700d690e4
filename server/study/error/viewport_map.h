// What the pixels of one viewport are to the eye in one frame: how far from the gaze, how large, and whether
// they are seen at all. Before: display profile and gaze. After: every error is an average over these.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sessions/format/display_profile.h"

namespace herr {

// Eccentricity from `from_deg` to below `to_deg`; the last one is all pixels together.
struct Band {
  const char* name;   // key in JSON and CSV: "0_5_deg", "all"
  const char* label;  // for people: "0–5°"
  double from_deg, to_deg;
};
inline constexpr std::size_t kBands = 6;      // 0-5, 5-15, 15-30, 30-45, 45-180, all
inline constexpr std::size_t kAllPixels = 5;  // index of the last
std::span<const Band, kBands> bands();

inline constexpr std::uint8_t kNotSeen = 255;

struct ViewportMap {
  int width_px = 0, height_px = 0;
  std::vector<float> eccentricity_deg;  // from the gaze to the pixel's middle
  std::vector<float> solid_angle_sr;
  // Degrees that one pixel to the right, and one down, take at this pixel.
  std::vector<float> degrees_per_column, degrees_per_row;
  std::vector<std::uint8_t> band;  // 0 ... 4; kNotSeen: a focus viewport of the same eye covers the pixel
  double pixels_per_degree = 0;    // mean over the width: width_px / its field of view in degrees
};

// `gaze`: unit vector in the space of the viewport's eye (-Z forward).
ViewportMap viewport_map(const DisplayProfile& profile, std::size_t viewport, const glm::dvec3& gaze);

}  // namespace herr
