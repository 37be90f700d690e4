// Stage: second rays by reflection. One mirror bounce for hits whose material asks for
// it, objects and catchers; where the frame follows light through glass, glass that is mirrored is seen
// through, and reflects.
#pragma once

#include "renderer/lighting/follow_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Remembers the weights of the next rays of the queue.
HWY_INLINE void append_weights(Lane3& weights, int at, const V3& weight, MF lanes) {
  hn::StoreU(hn::Compress(weight.x, lanes), kF, weights.x.data() + at);
  hn::StoreU(hn::Compress(weight.y, lanes), kF, weights.y.data() + at);
  hn::StoreU(hn::Compress(weight.z, lanes), kF, weights.z.data() + at);
}

// What `lanes` reflect by their roughness comes from all sides: they send no ray.
HWY_INLINE void stand_for_no_ray(HitBatch& hits, int slot, MF lanes) {
  const MF own = hn::And(lanes, hn::Gt(load(&hits.gloss->own[slot]), hn::Zero(kF)));
  store_lanes(hn::Zero(kF), own, &hits.mirror[slot]);
}

HWY_NOINLINE inline void queue_mirror_rays(const TileJob& job, int count) {
  TileScratch& scratch = *job.scratch;
  HitBatch& hits = scratch.first;
  const FramePlan& plan = *job.shading->plan;
  RayQueue& queue = scratch.queue;
  queue.count = 0;
  const VI lane = hn::Iota(kI, 0);
  for (int slot = 0; slot < count; slot += kLanes) {
    MF mirrors = of_kind(hits, slot, HitKind::object);
    if (plan.catcher_mirrors) mirrors = hn::Or(mirrors, of_kind(hits, slot, HitKind::catcher));
    if (hn::AllFalse(kF, mirrors)) continue;
    const V3 v = load3(hits.viewer, slot);
    const V3 n = load3(hits.normal, slot);
    V3 weight = mirror_weight(plan, hits, slot, dot(n, v));
    if (plan.refraction) {
      const VF one = set(1.0f);
      const Onward onward =
          onward_from(plan, hits, slot, {one, one, one}, first_lanes(0), kNegligibleWeight, false);
      weight = select(onward.clear, onward.back, weight);
    }
    const MF reflects = hn::And(mirrors, hn::Gt(largest(weight), set(kNegligibleWeight)));
    if (plan.gloss) stand_for_no_ray(hits, slot, hn::AndNot(reflects, mirrors));
    if (hn::AllFalse(kF, reflects)) continue;
    append_weights(scratch.second->weight, queue.count, weight, reflects);
    const V3 g = load3(hits.geometric_normal, slot);
    push(queue, ray_origin(hits, slot), mirrored(v, n, g), hn::Add(lane, hn::Set(kI, slot)), reflects);
  }
}

// The whole stage for first hits [0, count).
template <SurfaceDetail kDetail, Lobe kLobe>
HWY_NOINLINE void reflect_light(const TileJob& job, int count) {
  TileScratch& scratch = *job.scratch;
  const bool glass = job.shading->plan->refraction;
  if (job.shading->plan->catcher_mirrors) clear(scratch.first.mirrored, count);
  queue_mirror_rays(job, count);
  const int rays = scratch.queue.count;
  if (rays == 0) return;
  remember_senders(scratch);
  trace_second_rays<kDetail>(job, RayKind::mirror, 0x517cc1b7u);
  if (job.shading->plan->gloss) prepare_gloss(*job.shading->plan, scratch.second->hits, rays, glass);
  if constexpr (kLobe == Lobe::layered) cover_bases(scratch.second->hits, rays);
  if (glass) {
    remember_mirror_paths(scratch, rays);
    send_onward(job, rays);
  }
  bring_second_light<kLobe>(job, rays, RayKind::mirror_shadow, glass);
  if (glass) follow_rays<kDetail, kLobe>(job);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
