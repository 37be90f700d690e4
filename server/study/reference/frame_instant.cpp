#include "server/study/reference/frame_instant.h"

#include <cmath>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>

namespace herr {
namespace {

// Of what probes knew before, e^-8 = 0.03 % is left.
constexpr double kTimeConstantsToRest = 8;

void let_probes_rest(Renderer& renderer, const FrameInstant& instant) {
  const ProbeSettings& probes = renderer.settings().probes;
  const double period_s = 1.0 / instant.profile->display_hz;
  const auto frames = static_cast<TimeNs>(
      std::ceil(std::max(kTimeConstantsToRest * probes.hysteresis_tau_s / period_s, 8.0)));
  FrameSample sample = *instant.sample;
  for (TimeNs k = frames; k > 0; --k) {
    sample.t_ns =
        instant.sample->t_ns - static_cast<TimeNs>(std::llround(static_cast<double>(k) * period_s * 1e9));
    renderer.skip_frame(sample, *instant.state);
  }
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
