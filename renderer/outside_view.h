// A camera outside the headset, whose picture of the scene joins those of a frame, and the colour in which
// the real world is painted where there is no feed to show. Before: the server reads a view file. After:
// frame/render_outside.cpp draws it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "sessions/format/pose.h"

namespace herr {

// As pictures show it: sRGB, whatever their exposure.
struct ShownColour {
  std::uint8_t red = 0, green = 0, blue = 0;
  bool operator==(const ShownColour&) const = default;
};
inline constexpr ShownColour kPink{0xff, 0x8c, 0xc6};

// "RRGGBB" in hexadecimal digits, or "R,G,B" in whole numbers to 255. Throws std::invalid_argument that says
// what was wanted.
ShownColour shown_colour_from(const std::string& text);
std::string text_of(const ShownColour& colour);  // "ff8cc6"
// The radiance that is shown so where `white` is shown as white.
glm::vec3 radiance_of(const ShownColour& colour, float white);

enum class OutsideSpace : std::uint8_t { scene, session };

inline constexpr int kMostOutsideSide_px = 8192, kMostOutsideSamples = 8;
inline constexpr double kNarrowestOutside_deg = 0.1, kWidestOutside_deg = 170;

// A planar picture of uniform rays.
struct OutsideView {
  std::string name = "outside";              // of files, HTTP paths and EXR parts: [a-z0-9_]{1,40}
  OutsideSpace space = OutsideSpace::scene;  // what the pose is relative to
  Pose space_from_camera;                    // looks along -Z, +Y up
  double fov_deg = 50;                       // from the lower to the upper border; pixels are square
  int width_px = 1280, height_px = 720;      // 1 ... kMostOutsideSide_px
  int samples = 2;                           // rays along each axis of a pixel
  std::optional<ShownColour> see_through;    // real surfaces; none: that of the settings, else pink
  bool overlay = true;                       // head, gaze and frusta are drawn in
  double frusta_m = 1;                       // their far rectangles lie so far in front of the eyes
  bool operator==(const OutsideView&) const = default;
};

}  // namespace herr
