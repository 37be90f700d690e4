#include "server/study/reference/frame_instant.h"

#include <cstddef>
#include <glm/gtc/quaternion.hpp>

#include "server/frames/resting_probes.h"

namespace herr {
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
  let_probes_rest(*renderer, *instant.sample, *instant.state, instant.profile->display_hz);
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
