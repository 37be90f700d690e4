// A camera outside the headset, and its picture of a frame.
// Before: test_scenes.h. After: tests of what it shows, and of what it leaves as it is.
#pragma once

#include "tests/renderer/half_pixels.h"
#include "tests/renderer/test_scenes.h"

namespace herr::test {

// Looks along -Z from there, 90 degrees from border to border, twice as wide; one ray per pixel, no overlay.
inline OutsideView outside_from(const glm::dvec3& position, int height_px = 50) {
  OutsideView view;
  view.space_from_camera.position = position;
  view.fov_deg = 90;
  view.width_px = 2 * height_px;
  view.height_px = height_px;
  view.samples = 1;
  view.overlay = false;
  return view;
}

inline RenderSettings settings_with(const OutsideView& view) {
  RenderSettings settings = small_settings();
  settings.outside = view;
  return settings;
}

inline ViewportImage outside_picture(const Scene& scene, const RenderSettings& settings,
                                     const FrameSample& sample) {
  Renderer renderer(scene, small_profile(), settings, sample.cameras[0].has_value());
  RenderedFrame frame;
  render_with(renderer, scene, sample, frame);
  return frame.further.at(0).image;
}

}  // namespace herr::test
