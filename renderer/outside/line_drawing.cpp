#include "renderer/outside/line_drawing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "renderer/outside/half_values.h"
#include "renderer/probes/probe_distances.h"
#include "sessions/camera/half_from_samples.h"

namespace herr {
namespace {

// Thin lines at any size of a picture: a share of its shorter side, and never less than a pixel and a half.
constexpr double kThinShare = 1.0 / 480, kThinnest_px = 1.5;
constexpr double kRimShare = 0.6;      // of a thin line's width, on each side
constexpr float kRimDarkness = 0.55f;  // of what lies below
// A line this share of its distance behind a surface still lies on it: dots at the end of a gaze.
constexpr float kOnSurface = 2e-3f;

double thin_line_px(int width_px, int height_px) {
  return std::max(kThinnest_px, kThinShare * std::min(width_px, height_px));
}

// Columns of row y that a line may touch, `reach` pixels around it.
struct Columns {
  int begin, end;
};
Columns columns_touched(const ScreenLine& line, double y, double reach, int width_px) {
  const double dx = line.x1 - line.x0, dy = line.y1 - line.y0;
  double left = std::min(line.x0, line.x1) - reach, right = std::max(line.x0, line.x1) + reach;
  if (std::abs(dy) > 1e-9) {
    const double on_line = line.x0 + (y - line.y0) * dx / dy;
    const double aside = reach * std::hypot(dx, dy) / std::abs(dy);
    left = std::max(left, on_line - aside);
    right = std::min(right, on_line + aside);
  }
  const auto column = [width_px](double x) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(width_px)));
  };
  return {column(std::floor(left - 0.5)), column(std::ceil(right + 0.5))};
}

// The pixels of row y that the line covers, `wider_px` on each side, and that no surface hides.
void touch_row(const PictureCamera& camera, RTCScene scene, const ScreenLine& line, int y, double wider_px,
               LineScratch& scratch) {
  scratch.touched.clear();
  scratch.directions.clear();
  const double row = y + 0.5, reach = line.half_width_px + wider_px + 0.5;
  if (row < std::min(line.y0, line.y1) - reach || row > std::max(line.y0, line.y1) + reach) return;
  const Columns columns = columns_touched(line, row, reach, camera.width_px);
  const glm::dvec3 eye = camera.anchored_from_camera.position;
  for (int x = columns.begin; x < columns.end; ++x) {
    const LinePoint point = nearest_point(line, x + 0.5, row);
    const double share = std::clamp(reach - point.distance_px, 0.0, 1.0);
    if (share <= 0) continue;
    const double distance_m = glm::distance(point.place, eye);
    scratch.touched.push_back({x, static_cast<float>(share), static_cast<float>(distance_m)});
    scratch.directions.emplace_back((point.place - eye) / distance_m);
  }
  if (scratch.touched.empty()) return;
  trace_distances(scene, eye, kAllMask, scratch.directions, scratch.distances);
  for (std::size_t i = 0; i < scratch.touched.size(); ++i) {
    LineScratch::Touched& pixel = scratch.touched[i];
    if (scratch.distances[i] < pixel.distance_m * (1 - kOnSurface)) pixel.share = 0;
  }
}

// image <- image + share (colour - image).
void blend_into(std::uint16_t* texel, const glm::vec3& colour, float share) {
  std::int64_t sanitised = 0;  // finite colours are not
  for (int c = 0; c < 3; ++c) {
    const float now = value_of_half(texel[c]);
    texel[c] = half_from_linear(now + share * (colour[c] - now), sanitised);
  }
}

}  // namespace

PictureCamera picture_camera(const OutsideView& view, const Pose& anchored_from_camera) {
  const double tan_up = std::tan(glm::radians(0.5 * view.fov_deg));
  return {anchored_from_camera, tan_up * view.width_px / view.height_px, tan_up, view.width_px,
          view.height_px};
}

std::optional<ScreenLine> screen_line(const PictureCamera& camera, const OverlayLine& line) {
  const Pose camera_from_anchored = inverse(camera.anchored_from_camera);
  glm::dvec3 a = camera_from_anchored(line.from), b = camera_from_anchored(line.to);
  ScreenLine shown;
  shown.from = line.from, shown.to = line.to;
  const bool a_hidden = -a.z < kOverlayNear_m, b_hidden = -b.z < kOverlayNear_m;
  if (a_hidden && b_hidden) return std::nullopt;
  if (a_hidden || b_hidden) {
    const double t = (-kOverlayNear_m - a.z) / (b.z - a.z);
    (a_hidden ? a : b) = a + t * (b - a);
    (a_hidden ? shown.from : shown.to) = line.from + t * (line.to - line.from);
  }
  const auto x_of = [&](const glm::dvec3& p) {
    return 0.5 * camera.width_px * (1 + p.x / -p.z / camera.tan_right);
  };
  const auto y_of = [&](const glm::dvec3& p) {
    return 0.5 * camera.height_px * (1 - p.y / -p.z / camera.tan_up);
  };
  shown.x0 = x_of(a), shown.y0 = y_of(a), shown.x1 = x_of(b), shown.y1 = y_of(b);
  shown.nearness0 = 1 / -a.z, shown.nearness1 = 1 / -b.z;
  shown.half_width_px = 0.5 * line.width * thin_line_px(camera.width_px, camera.height_px);
  shown.colour = line.colour;
  return shown;
}

LinePoint nearest_point(const ScreenLine& line, double x, double y) {
  const double dx = line.x1 - line.x0, dy = line.y1 - line.y0;
  const double length2 = dx * dx + dy * dy;
  const double t =
      length2 > 0 ? std::clamp(((x - line.x0) * dx + (y - line.y0) * dy) / length2, 0.0, 1.0) : 0.0;
  // In space, equal steps of the picture are longer where the line is farther away.
  const double nearness = line.nearness0 + t * (line.nearness1 - line.nearness0);
  const double along = t * line.nearness1 / nearness;
  return {std::hypot(x - line.x0 - t * dx, y - line.y0 - t * dy), line.from + along * (line.to - line.from)};
}

LineScratch::LineScratch(int widest_px) {
  const auto pixels = static_cast<std::size_t>(widest_px);
  touched.reserve(pixels);
  directions.reserve(pixels);
  distances.reserve(pixels);
}

void draw_lines(const PictureCamera& camera, RTCScene scene, std::span<const ScreenLine> lines, int y0,
                int y1, LineScratch& scratch, ViewportImage& image) {
  const double rim_px = kRimShare * thin_line_px(camera.width_px, camera.height_px);
  for (const bool rim : {true, false}) {
    for (const ScreenLine& line : lines) {
      const glm::vec3 colour = rim ? glm::vec3{0.0f} : radiance_of(line.colour, 1.0f / image.exposure);
      for (int y = y0; y < y1; ++y) {
        touch_row(camera, scene, line, y, rim ? rim_px : 0, scratch);
        for (const LineScratch::Touched& pixel : scratch.touched) {
          blend_into(image.row(y) + 4 * pixel.x, colour, pixel.share * (rim ? kRimDarkness : 1.0f));
        }
      }
    }
  }
}

}  // namespace herr
