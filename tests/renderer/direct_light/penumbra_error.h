// How far soft shadows of a straight edge are off. Before: penumbra_scene.h. After: tests of light samples.
#pragma once

#include <cmath>
#include <vector>

#include "tests/renderer/penumbra_scene.h"
#include "tests/renderer/rendered_frames.h"

namespace herr::test {

// Mean absolute error of the visible share over the penumbra, for N samples.
inline double penumbra_error(const glm::vec3& light_size, int samples, int first_samples = 0,
                             FrameCounters* counters = nullptr) {
  const Scene scene = edge_scene(light_size);
  const DisplayProfile profile = penumbra_view(96, 24);
  RenderSettings settings = planar_settings();
  settings.light_samples = samples;
  settings.adaptive_min_samples = first_samples;
  const RenderedFrame frame = render(scene, profile, settings, penumbra_sample());
  Scene open = scene;
  open.instances.pop_back();
  const RenderedFrame unshadowed = render(open, profile, settings, penumbra_sample());
  if (counters) *counters = frame.counters;
  const std::vector<double> seen = shares_of(frame.viewports[0], unshadowed.viewports[0]),
                            exact = exact_shares(scene.lights[0], profile.viewports[0]);
  double sum = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) sum += std::abs(seen[i] - exact[i]);
  return sum / static_cast<double>(seen.size());
}

}  // namespace herr::test
