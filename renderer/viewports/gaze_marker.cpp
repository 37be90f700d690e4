#include "renderer/viewports/gaze_marker.h"

#include <algorithm>
#include <cmath>

#include "renderer/foveation/gaze_frame.h"
#include "renderer/foveation/polar_map.h"
#include "sessions/camera/half_from_samples.h"

namespace herr {
namespace {

constexpr double kRadius_deg = 1.0, kHalfWidth_deg = 0.08, kReach = 1.2;
constexpr float kRed = 1.0f, kOthers = 0.03125f;  // as shown
constexpr std::uint16_t kOpaqueHalf = 0x3c00;

}  // namespace

void draw_gaze_marker(const Viewport& v, const glm::dvec3& gaze, ViewportImage& image) {
  if (!(gaze.z < -1e-6)) return;
  const double step_x = (v.tan_right - v.tan_left) / v.width_px,
               step_y = (v.tan_up - v.tan_down) / v.height_px;
  const double tx = gaze.x / -gaze.z, ty = gaze.y / -gaze.z;
  // The ring's reach on the plane grows with 1 / cos^2 off the axis.
  const double reach = std::tan(kReach * kRadius_deg / kDegreesPerRadian) * (1 + tx * tx + ty * ty) * 1.5;
  const auto clamp_px = [](double x, int limit) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(limit)));
  };
  const int x0 = clamp_px((tx - reach - v.tan_left) / step_x, v.width_px);
  const int x1 = clamp_px((tx + reach - v.tan_left) / step_x + 1, v.width_px);
  const int y0 = clamp_px((v.tan_up - ty - reach) / step_y, v.height_px);
  const int y1 = clamp_px((v.tan_up - ty + reach) / step_y + 1, v.height_px);
  std::int64_t sanitised = 0;  // a finite colour is not
  const std::uint16_t red = half_from_linear(kRed / image.exposure, sanitised),
                      others = half_from_linear(kOthers / image.exposure, sanitised);
  const double pixel_deg = step_x * kDegreesPerRadian;
  const double half_width = std::max(kHalfWidth_deg, 0.75 * pixel_deg);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const glm::dvec3 direction{v.tan_left + (x + 0.5) * step_x, v.tan_up - (y + 0.5) * step_y, -1.0};
      if (std::abs(eccentricity_deg(gaze, direction) - kRadius_deg) > half_width) continue;
      std::uint16_t* texel = image.row(y) + 4 * x;
      texel[0] = red;
      texel[1] = texel[2] = others;
      texel[3] = kOpaqueHalf;
    }
  }
}

}  // namespace herr
