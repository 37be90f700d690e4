// The lights of one frame: records, and the points that stand for them where samples are adaptive. Before:
// where the eyes and the scene are. After: tiles.
#include <algorithm>

#include "renderer/direct_light/light_records.h"
#include "renderer/direct_light/shading_points.h"
#include "renderer/frame/renderer_impl.h"

namespace herr {

LightReach Renderer::Impl::light_reach() const {
  double eyes_m = 0;
  for (const EyeView& eye : eyes) eyes_m = std::max(eyes_m, glm::length(eye.anchored_from_eye.position));
  return {beyond_scene_m, eyes_m};
}

void Renderer::Impl::update_lights(const SceneState& state, const FrameQuality& quality) {
  light_records(state.lights, geometry->anchor(), plan.light_sampling(quality.light_samples), light_reach(),
                lights);
  shading_points(lights, light_points);
  shading.lights = lights;
  shading.points = light_points;
}

}  // namespace herr
