// Antialiased lines in space, drawn into a finished picture: dark rims first, then the lines, each where no
// geometry lies before it. Before: overlay_lines; the picture's own pixels. After: the picture is whole.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "renderer/embree/embree_api.h"
#include "renderer/outside/overlay_lines.h"
#include "renderer/viewport_image.h"

namespace herr {

// A planar camera. Pixel (x, y) has its centre at (x + 1/2, y + 1/2), (0, 0) being the upper left corner.
struct PictureCamera {
  Pose anchored_from_camera;
  double tan_right = 1, tan_up = 1;  // half-angles: the borders lie at +- these
  int width_px = 1, height_px = 1;
};
PictureCamera picture_camera(const OutsideView& view, const Pose& anchored_from_camera);

// A line as the picture shows it, what lies nearer to the camera than its near plane cut off.
struct ScreenLine {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // pixels
  double nearness0 = 1, nearness1 = 1;    // 1 / depth, linear along the line
  glm::dvec3 from{0.0}, to{0.0};          // what is left of it, metres from the anchor
  double half_width_px = 1;
  ShownColour colour;
};
inline constexpr double kOverlayNear_m = 0.01;

// None where the line lies behind the near plane.
std::optional<ScreenLine> screen_line(const PictureCamera& camera, const OverlayLine& line);
// The point of the line nearest to the pixel place (x, y): the distance in pixels, and where it is in space.
struct LinePoint {
  double distance_px;
  glm::dvec3 place;
};
LinePoint nearest_point(const ScreenLine& line, double x, double y);

// One worker's memory for a row of pixels.
struct LineScratch {
  explicit LineScratch(int widest_px);
  struct Touched {
    int x;
    float share;
    float distance_m;
  };
  std::vector<Touched> touched;
  std::vector<glm::vec3> directions;
  std::vector<float> distances;
};

// Draws what lies in rows [y0, y1). Thread-safe for rows that differ. `scene` in the anchor's space.
void draw_lines(const PictureCamera& camera, RTCScene scene, std::span<const ScreenLine> lines, int y0,
                int y1, LineScratch& scratch, ViewportImage& image);

}  // namespace herr
