// What tests of indirect light share: settings with probes, frames at given times, and the light that only
// probes bring to each pixel.
// Before: test_scenes.h makes scenes. After: probe tests compare with closed forms.
#pragma once

#include <vector>

#include "renderer/frame/renderer_impl.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr::test {

inline RenderSettings probe_settings(double tau_s = 0.365) {
  RenderSettings settings = planar_settings();
  settings.probes.on = true;
  settings.probes.hysteresis_tau_s = tau_s;
  settings.threads = 2;
  return settings;
}

// Renders frame after frame of one renderer at 90 Hz.
class ProbeRun {
 public:
  ProbeRun(Scene scene_in, const DisplayProfile& profile, const RenderSettings& settings,
           const FrameSample& sample_in)
      : scene(std::move(scene_in)),
        sample(sample_in),
        renderer(scene, profile, settings, sample_in.cameras[0].has_value()) {
    scene_state_at(scene, 0.0, state);
  }
  void run(int frames, double hz = 90) {
    for (int i = 0; i < frames; ++i) {
      renderer.render_frame(sample, state, frame);
      sample.t_ns += static_cast<TimeNs>(std::llround(1e9 / hz));
    }
  }
  ProbeVolume& volume() { return *renderer.internals().probes; }

  Scene scene;
  FrameSample sample;
  SceneState state;
  Renderer renderer;
  RenderedFrame frame;
};

// Share of light from all sides that a matte dielectric scatters: its diffuse albedo, and 4 % of the rest.
inline double scattered_share(double albedo) {
  return albedo + 0.04 * (1 - albedo);
}

// What probes add to each pixel (green) of an image of surfaces of one albedo: the
// light from all sides there.
inline std::vector<double> indirect_of_pixels(const ViewportImage& with_probes, const ViewportImage& direct,
                                              double albedo) {
  std::vector<double> light, lit;
  for_each_pixel(direct, [&](int, int, const Pixel& pixel) { lit.push_back(pixel[1]); });
  std::size_t i = 0;
  for_each_pixel(with_probes, [&](int, int, const Pixel& pixel) {
    light.push_back((pixel[1] - lit[i++]) / scattered_share(albedo));
  });
  return light;
}

inline double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace herr::test
