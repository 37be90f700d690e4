#include "server/quality/frame_cost.h"

#include <numeric>

namespace herr {
namespace {

void add_times(const StageTimes& times, FrameCost& cost) {
  auto& [eye, occlusion, second, light, probe] = cost.work_ms;
  eye = times[Stage::polar_rays] + times[Stage::first_hits] + times[Stage::surfaces] +
        times[Stage::indirect_light] + times[Stage::edges] + times[Stage::resolve];
  occlusion = times[Stage::occlusion];
  second = times[Stage::second_hits];
  light = times[Stage::light_rays] + times[Stage::second_light];
  probe = times[Stage::probe_rays] + times[Stage::probe_update];
  const double work = std::accumulate(cost.work_ms.begin(), cost.work_ms.end(), 0.0);
  const double parallel = work + times[Stage::viewports];
  if (!(parallel > 0)) return;
  const double with_idle = 1 + times[Stage::idle] / parallel;
  for (double& ms : cost.work_ms) ms *= with_idle;
}

void add_rays(const RayCounts& rays, FrameCost& cost) {
  auto& [eye, occlusion, second, light, probe] = cost.rays;
  eye = rays[RayKind::primary];  // those through edges are a share of them
  occlusion = rays[RayKind::occlusion] + rays[RayKind::catcher_occlusion];
  second = rays[RayKind::mirror] + rays[RayKind::refraction];
  light = rays[RayKind::shadow] + rays[RayKind::catcher_shadow] + rays[RayKind::mirror_shadow] +
          rays[RayKind::refraction_shadow];
  probe = rays[RayKind::probe] + rays[RayKind::probe_shadow] + rays[RayKind::catcher_probe] +
          rays[RayKind::catcher_probe_shadow];
}

}  // namespace

FrameCost frame_cost(const RenderedFrame& frame, double total_ms, bool missed, TimeNs finished_ns) {
  FrameCost cost;
  cost.finished_ns = finished_ns;
  cost.total_ms = total_ms;
  cost.missed = missed;
  cost.quality = frame.quality;
  add_times(frame.times, cost);
  add_rays(frame.counters.rays, cost);
  return cost;
}

}  // namespace herr
