// What a changed scene means beyond its acceleration structures: how far light must reach, and which stages
// and kernels this frame runs. Before: EmbreeScene::update. After: lights, probes and tiles of the frame.
#include <algorithm>

#include "renderer/frame/renderer_impl.h"

namespace herr {

void Renderer::Impl::measure_reach() {
  const Bounds& all = boxes.all();
  const double diagonal_m = all.upper.x >= all.lower.x ? glm::length(all.upper - all.lower) : 0.0;
  geometry->fit_anchor(diagonal_m);
  beyond_scene_m = diagonal_m > 0 ? 2.0 * diagonal_m : 1.0;
  double farthest_m = diagonal_m > 0 ? std::max(glm::length(all.lower), glm::length(all.upper)) : 0.0;
  for (const AreaLight& light : scene.lights) {
    const double around_m = light.path_radius_m + glm::length(glm::dvec3(light.size));
    farthest_m = std::max(farthest_m, glm::length(light.centre) + around_m);
  }
  if (scene.probes.box) {
    farthest_m =
        std::max({farthest_m, glm::length(scene.probes.box->lower), glm::length(scene.probes.box->upper)});
  }
  if (settings.outside) {  // wherever its space stands, no farther than both together
    farthest_m = std::max(farthest_m, glm::length(settings.outside->space_from_camera.position) +
                                          glm::length(scene.world_from_session.position));
  }
  if (geometry->expect_rays(2.0 * farthest_m + beyond_scene_m))
    threads.inside([this] { geometry->place_at(glm::dvec3(geometry->anchor())); });
}

// True if another feature runs, or one no longer does. What memory was set up for stays: the probes, and
// whether the ratio of catchers has channels of its own, are the same whatever is there at the moment.
bool Renderer::Impl::replan() {
  FramePlan next = plan_frame(scene, settings, session_has_camera);
  const bool wider = next.coloured_ratio && !plan.coloured_ratio;
  if (plan.coloured_ratio && !next.coloured_ratio) {
    next.coloured_ratio = true;
    for (PlanEntry& entry : next.entries) {
      if (entry.name == kColouredRatio) entry = {entry.name, true, "kept: it was needed before"};
    }
  }
  const bool same = differing_entries(plan, next).empty();
  plan = std::move(next);
  if (wider) allocate_buffers();
  allocate_scratch();
  if (plan.probes) plan_probes();
  return !same;
}

// True if the plan is another one.
bool Renderer::Impl::follow(const SceneUpdate& update, const SceneState& state) {
  boxes.update(update.slots);
  if (probe_motion) probe_motion->note(update.slots, state, *geometry, boxes);
  measure_reach();
  return (update.other_traits() || update.relit) && replan();
}

// Renderer::restart().
void Renderer::Impl::restart(const SceneState& state) {
  SceneUpdate nobodys;
  geometry->apply(state, nobodys);
  show_full_details();
  boxes.update(nobodys.slots);
  measure_reach();
  plan = plan_frame(scene, settings, session_has_camera);
  allocate_buffers();
  allocate_scratch();
  geometry->leave_anchor();
  if (!probes) return;
  plan_probes();
  probes->start_anew();
  place_for_probes();
  if (!probe_motion) return;
  ProbePlacement::settle(*probes, scene, *geometry, threads);
  probe_motion->start_anew(*geometry, boxes);
}

}  // namespace herr
