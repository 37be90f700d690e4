#include "renderer/viewports/viewport_job.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace herr {
namespace {

glm::dvec3 eye_direction(const Viewport& v, double x, double y) {
  return {v.tan_left + (x + 0.5) * (v.tan_right - v.tan_left) / v.width_px,
          v.tan_up - (y + 0.5) * (v.tan_up - v.tan_down) / v.height_px, -1.0};
}

}  // namespace

PixelToGaze pixel_to_gaze(const Viewport& v, const GazeFrame& frame) {
  const glm::dvec3 base = eye_direction(v, 0, 0);
  const glm::dvec3 per_x{(v.tan_right - v.tan_left) / v.width_px, 0, 0};
  const glm::dvec3 per_y{0, -(v.tan_up - v.tan_down) / v.height_px, 0};
  PixelToGaze map{};
  const std::array<glm::dvec3, 3> axes{frame.right, frame.up, frame.gaze};
  for (std::size_t i = 0; i < 3; ++i) {
    map.base[i] = static_cast<float>(glm::dot(base, axes[i]));
    map.per_x[i] = static_cast<float>(glm::dot(per_x, axes[i]));
    map.per_y[i] = static_cast<float>(glm::dot(per_y, axes[i]));
  }
  return map;
}

float exact_below_deg(const Viewport& v, const PolarMap& map, int width, int height) {
  constexpr double kTolerance = 1.0 / 16.0;  // samples
  // Radians and degrees per pixel where the planar image is coarsest, its centre.
  const double s = std::max((v.tan_right - v.tan_left) / v.width_px, (v.tan_up - v.tan_down) / v.height_px);
  const double s_deg = s * kDegreesPerRadian;
  const double cell2 = kCellSide * kCellSide;
  const auto error_at = [&](double theta) {
    const double u_curve = width / map.log_range / (theta * (1 + theta));
    const double v_curve = height / (2 * glm::pi<double>()) / (theta * theta);
    const double slope =
        std::max(width / map.log_range / (1 + theta), height / (360.0 * std::sin(theta / kDegreesPerRadian)));
    const double on_sphere = 2 * cell2 / 8 * s_deg * s_deg * std::max(u_curve, v_curve);
    const double by_plane = 2 * cell2 / 8 * 0.65 * s * s * kDegreesPerRadian * slope;
    return on_sphere + by_plane;
  };
  for (double theta = 0.25; theta < 90.0; theta *= 1.05) {
    if (error_at(theta) < kTolerance) {
      // A cell is judged by its corners: none of its points is nearer than a corner less half a diagonal.
      return static_cast<float>(theta + s_deg * kCellSide * 0.7072);
    }
  }
  return 180.0f;
}

std::optional<glm::dvec2> camera_pixel(const Viewport& viewport, const FeedView& feed, double x, double y) {
  return camera_pixel(feed, eye_direction(viewport, x, y));
}

StripScratch::StripScratch(int widest_px)
    : corner_stride(static_cast<std::size_t>(widest_px / kCellSide + 40) / 16 * 16),
      camera_stride(static_cast<std::size_t>(widest_px / kBlockColumns + 4)) {
  u.resize(3 * corner_stride);
  v.resize(3 * corner_stride);
  theta.resize(3 * corner_stride);
  camera_x.resize(3 * camera_stride);
  camera_y.resize(3 * camera_stride);
  camera_valid.resize(3 * camera_stride);
}

std::int64_t StripScratch::bytes() const {
  const std::size_t floats =
      u.capacity() + v.capacity() + theta.capacity() + camera_x.capacity() + camera_y.capacity();
  return static_cast<std::int64_t>(sizeof(StripScratch) + floats * sizeof(float) + camera_valid.capacity());
}

}  // namespace herr
