// The viewport stage alone: a job around a hand-made radiance buffer, and the instruction sets to run it on.
// Before: a test fills the buffer. After: the test reads the composited picture.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <vector>

#include "renderer/foveation/ray_grids.h"
#include "renderer/viewports/viewport_job.h"

namespace herr::test {

inline Viewport viewport_deg(Eye eye, int width_px, int height_px, double left_deg, double right_deg,
                             double down_deg, double up_deg) {
  Viewport v;
  v.name = "viewport";
  v.eye = eye;
  v.width_px = width_px;
  v.height_px = height_px;
  v.tan_left = std::tan(left_deg / kDegreesPerRadian);
  v.tan_right = std::tan(right_deg / kDegreesPerRadian);
  v.tan_down = std::tan(down_deg / kDegreesPerRadian);
  v.tan_up = std::tan(up_deg / kDegreesPerRadian);
  return v;
}

// Unit direction in eye space of the centre of pixel (x, y).
inline glm::dvec3 direction_of_pixel(const Viewport& v, double x, double y) {
  return glm::normalize(glm::dvec3{v.tan_left + (x + 0.5) * (v.tan_right - v.tan_left) / v.width_px,
                                   v.tan_up - (y + 0.5) * (v.tan_up - v.tan_down) / v.height_px, -1.0});
}

// Yaw to the right, pitch upwards.
inline glm::dvec3 gaze_deg(double yaw_deg, double pitch_deg) {
  const double yaw = yaw_deg / kDegreesPerRadian, pitch = pitch_deg / kDegreesPerRadian;
  return {std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
}

// Those that this CPU offers.
inline std::vector<Isa> offered_isas() {
  std::vector<Isa> offered;
  for (const Isa isa : {Isa::sse4, Isa::avx2, Isa::avx512}) {
    try {
      offered.push_back(resolve_isa(isa));
    } catch (const std::invalid_argument&) {  // this CPU lacks it: nothing to test
    }
  }
  return offered;
}

// A polar buffer of its own for one viewport. Neither copied nor moved: the job points into it.
struct PolarPicture {
  PolarPicture(const Viewport& viewport_in, const glm::dvec3& gaze, int width, int height)
      : viewport(viewport_in), frame(gaze_frame(gaze)) {
    map = PolarMap::up_to(theta_max_deg(frame, {&viewport, 1}, viewport.eye));
    buffer.allocate(padded_columns(width), padded_rows(height), false);
    image.resize(viewport.width_px, viewport.height_px);
    job.viewport = &viewport;
    job.out = &image;
    job.radiance = &buffer;
    job.polar_width = width;
    job.polar_height = height;
    job.theta_to_column = static_cast<float>(width / map.log_range);
    job.to_gaze = pixel_to_gaze(viewport, frame);
    job.exact_below_deg = exact_below_deg(viewport, map, width, height);
  }
  PolarPicture(const PolarPicture&) = delete;
  PolarPicture& operator=(const PolarPicture&) = delete;

  // Texel of sample (column, row); -1 and `width`, and row `height`, are the padding.
  std::uint16_t* texel(int column, int row) {
    return buffer.texels() +
           4 * (static_cast<std::size_t>(row) * buffer.row_stride() + static_cast<std::size_t>(column + 1));
  }

  void composite(Isa isa) {
    const CompositeStrip strip = composite_strip_for(isa);
    StripScratch scratch(viewport.width_px);
    for (int i = 0; i * kStripRows < viewport.height_px; ++i) strip(job, i, scratch);
  }

  Viewport viewport;
  GazeFrame frame;
  PolarMap map;
  RadianceBuffer buffer;
  ViewportImage image;
  ViewportJob job;
};

}  // namespace herr::test
