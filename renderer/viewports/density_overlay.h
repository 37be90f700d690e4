// Lines of equal eccentricity and of equal sample density over a finished viewport, with their numbers. Both
// are circles: about the gaze, and without foveation those of density about the view axis. Density is samples
// per degree in the direction that has fewer. Before: composited viewports. After: gaze marker, encoders.
// Source: the polar map (foveation/polar_map.h); of a plane of rays s apart at distance 1, an angle a off its
// axis: s cos a radians from ray to ray around the axis, s cos^2 a along the radius.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "renderer/foveation/gaze_frame.h"
#include "renderer/foveation/polar_map.h"
#include "renderer/viewport_image.h"
#include "sessions/format/display_profile.h"

namespace herr {

enum class OverlayLineKind : std::uint8_t { degrees, density };

// Circles about one direction, those nearer to it first.
struct OverlayCircles {
  static constexpr int kMost = 16;
  struct Circle {
    double theta_deg = 0;  // off the axis
    int number = 0;        // what the line stands for: degrees, or samples per degree
  };
  OverlayLineKind kind = OverlayLineKind::degrees;
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}, axis{0, 0, -1};  // in the eye's space
  int count = 0;
  std::array<Circle, kMost> circles;

  void add(double theta_deg, int number) { circles[static_cast<std::size_t>(count++)] = {theta_deg, number}; }
};

// 1, 2, 5, 10, 15, 20, 30 ... 90 degrees off the gaze.
OverlayCircles degree_circles(const GazeFrame& gaze);
// 100, 50, 20, 10, 5, 2 and 1 samples per degree, as far as the map reaches: of a polar buffer of `width` x
// `height` samples;
OverlayCircles density_circles(const GazeFrame& gaze, const PolarMap& map, int width, int height);
// and of `columns` x `rows` rays over the viewport. Levels below that of its middle have no circle.
OverlayCircles density_circles(const Viewport& viewport, int columns, int rows);

// The lines in rows [y0, y1), at least 1.5 pixels wide. Thread-safe for rows that differ.
void draw_overlay_lines(const Viewport& viewport, const OverlayCircles& circles, int y0, int y1,
                        ViewportImage& image);
// A number at each line that has room for it inside the picture: degrees from `right` of the axis on,
// counter-clockwise, density from the opposite side.
void draw_overlay_numbers(const Viewport& viewport, const OverlayCircles& circles, ViewportImage& image);

}  // namespace herr
