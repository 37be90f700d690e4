// What a changed scene means beyond its acceleration structures: how far light must reach, and which stages
// and kernels this frame runs. Before: EmbreeScene::update. After: lights, probes and tiles of the frame.
#include <algorithm>

#include "renderer/frame/renderer_impl.h"

namespace herr {

void Renderer::Impl::measure_reach() {
  const Bounds& all = boxes.all();
  beyond_scene_m = all.upper.x >= all.lower.x ? 1.0 + 2.0 * glm::length(all.upper - all.lower) : 1.0;
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
bool Renderer::Impl::follow(const SceneUpdate& update) {
  boxes.update(update.slots);
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
}

}  // namespace herr
