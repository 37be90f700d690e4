#include "server/study/reference/frame_instant.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>

namespace herr {
namespace {

// First in long steps, to gather light of many bounces, then at the display's rate, for the noise that its
// frames have. Of the long steps' noise, whose variance is six times that, e^-4 = 2 % is left.
constexpr int kLongSteps = 16;
constexpr double kLongStep_s = 0.15, kTimeConstantsAtRate = 2;
constexpr TimeNs kFewestAtRate = 8;

void let_probes_rest(Renderer& renderer, const FrameInstant& instant) {
  const double tau_s = renderer.settings().probes.hysteresis_tau_s;
  const double period_s = 1.0 / instant.profile->display_hz;
  const auto at_rate =
      std::max(kFewestAtRate, static_cast<TimeNs>(std::ceil(kTimeConstantsAtRate * tau_s / period_s)));
  const double rate_s = static_cast<double>(at_rate) * period_s;
  FrameSample sample = *instant.sample;
  const auto gather_at = [&](double before_s) {
    sample.t_ns = instant.sample->t_ns - static_cast<TimeNs>(std::llround(before_s * 1e9));
    renderer.skip_frame(sample, *instant.state);
  };
  for (int k = kLongSteps; k > 0; --k) gather_at(rate_s + k * kLongStep_s);
  for (TimeNs k = at_rate; k > 0; --k) gather_at(static_cast<double>(k) * period_s);
}

}  // namespace

std::vector<ViewportMap> viewport_maps(const FrameSample& sample, const DisplayProfile& profile) {
  std::vector<ViewportMap> maps;
  for (std::size_t i = 0; i < profile.viewports.size(); ++i) {
    const auto eye = static_cast<std::size_t>(profile.viewports[i].eye);
    const glm::dquat head_from_eye = sample.head_from_eye[eye].orientation;
    maps.push_back(viewport_map(profile, i, glm::conjugate(head_from_eye) * sample.gaze.head_direction[eye]));
  }
  return maps;
}

std::unique_ptr<Renderer> renderer_at(const FrameInstant& instant, const RenderSettings& settings) {
  auto renderer =
      std::make_unique<Renderer>(*instant.scene, *instant.profile, settings, instant.session_has_camera);
  if (renderer->plan().probes) let_probes_rest(*renderer, instant);
  return renderer;
}

void read_viewports(const RenderedFrame& frame, const FrameInstant& instant, const ParallelFor& parallel_for,
                    std::vector<LinearPicture>& out) {
  out.resize(frame.viewports.size());
  parallel_for(static_cast<int>(out.size()), [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    read_viewport(frame.viewports[index], out[index]);
    const std::vector<std::uint8_t>& band = instant.maps[index].band;
    for (auto& plane : out[index].plane) {
      for (std::size_t p = 0; p < plane.size(); ++p) plane[p] = band[p] == kNotSeen ? 0.0f : plane[p];
    }
  });
}

ParallelFor threads_of(Renderer& renderer) {
  return [&renderer](int count, const std::function<void(int)>& work) { renderer.parallel_for(count, work); };
}

}  // namespace herr
