// The viewport stage alone: a job around a hand-made radiance buffer, and the instruction sets to run it on.
// Before: a test fills the buffer. After: the test reads the composited picture.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <vector>

#include "renderer/foveation/ray_grids.h"
#include "renderer/viewports/viewport_job.h"
#include "tests/renderer/half_pixels.h"

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

  // Texel of sample (column, row), or of the border.
  std::uint16_t* texel(int column, int row) {
    return buffer.texels() + 4 * texel_index(buffer.row_stride(), column, row);
  }

  // f(direction) as colour of the samples, border included; the feed is not kept.
  void fill(const std::function<double(const glm::dvec3&)>& f) {
    const int width = job.polar_width, height = job.polar_height;
    const auto value = [&](int column, int row) {
      const double theta = map.theta_from_u((column + 0.5) / width) / kDegreesPerRadian;
      const double phi = phi_from_v((row + 0.5) / height);
      return f(std::cos(theta) * frame.gaze +
               std::sin(theta) * (std::cos(phi) * frame.right + std::sin(phi) * frame.up));
    };
    for (int row = -kBorderAbove; row < height + kBorderBelow; ++row) {
      const int wrapped = (row + height) % height;
      for (int column = -kBorderLeft; column < width + kBorderRight; ++column) {
        const double v = column < 0 ? value(-1 - column, (wrapped + height / 2) % height)
                                    : value(std::min(column, width - 1), wrapped);
        std::fill_n(texel(column, row), 3, to_half(v));
        texel(column, row)[3] = 0;
      }
    }
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
