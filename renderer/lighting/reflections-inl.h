// Stage: second rays by reflection. One mirror bounce for hits whose material asks for
// it, objects and catchers.
#pragma once

#include "renderer/lighting/second_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Direction mirrored at the normal; `v` is towards the viewer. An interpolated normal can send the ray into
// the surface; the triangle's own normal never does.
HWY_INLINE V3 mirrored(const V3& v, const V3& n, const V3& g) {
  const auto reflect = [&](const V3& normal) HWY_ATTR {
    return mul_add(hn::Mul(set(2.0f), dot(normal, v)), normal, scale(v, set(-1.0f)));
  };
  const V3 bent = reflect(n);
  return select(hn::Gt(dot(bent, g), hn::Zero(kF)), bent, reflect(g));
}

// Share of the mirror ray that is seen, per channel: mirror * (F0 + (F90 - F0) (1 - n.v)^5); F90 is 1 unless
// highlights are `weighted`.
HWY_INLINE V3 mirror_weight(const HitBatch& hits, int slot, VF cosine, bool weighted) {
  const VF one = set(1.0f), grazing = schlick_weight(cosine), mirror = load(&hits.mirror[slot]);
  const VF f90 = weighted ? load(&hits.f90[slot]) : one;
  const V3 f0 = load3(hits.f0, slot);
  return scale(mul_add(grazing, sub({f90, f90, f90}, f0), f0), mirror);
}

HWY_NOINLINE inline void queue_mirror_rays(const TileJob& job, int count) {
  TileScratch& scratch = *job.scratch;
  const HitBatch& hits = scratch.first;
  RayQueue& queue = scratch.queue;
  queue.count = 0;
  const VI lane = hn::Iota(kI, 0);
  for (int slot = 0; slot < count; slot += kLanes) {
    MF mirrors = of_kind(hits, slot, HitKind::object);
    if (job.shading->plan->catcher_mirrors) {
      mirrors = hn::Or(mirrors, of_kind(hits, slot, HitKind::catcher));
    }
    if (hn::AllFalse(kF, mirrors)) continue;
    const V3 v = load3(hits.viewer, slot);
    const V3 n = load3(hits.normal, slot);
    const V3 weight = mirror_weight(hits, slot, dot(n, v), job.shading->plan->surface_details);
    const MF reflects = hn::And(mirrors, hn::Gt(largest(weight), set(kNegligibleWeight)));
    if (hn::AllFalse(kF, reflects)) continue;
    store3(weight, scratch.second->weight, slot);
    const V3 g = load3(hits.geometric_normal, slot);
    push(queue, ray_origin(hits, slot), mirrored(v, n, g), hn::Add(lane, hn::Set(kI, slot)), reflects);
  }
}

// The whole stage for first hits [0, count).
template <SurfaceDetail kDetail, Lobe kLobe>
HWY_NOINLINE void reflect_light(const TileJob& job, int count) {
  TileScratch& scratch = *job.scratch;
  if (job.shading->plan->catcher_mirrors) clear(scratch.first.mirrored, count);
  queue_mirror_rays(job, count);
  const int rays = scratch.queue.count;
  if (rays == 0) return;
  remember_senders(scratch);
  trace_second_rays<kDetail>(job, RayKind::mirror, 0x517cc1b7u);
  job.cycles->lap(Stage::second_hits);
  direct_light<kLobe>(job, scratch.second->hits, rays, RayKind::mirror_shadow);
  light_indirectly(job, rays);
  gather_second_light(job, rays);
  job.cycles->lap(Stage::second_light);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
