// Stage: second rays by refraction. Light that passes transparent first hits is followed from interface to
// interface by Snell's law, and parts there by Fresnel's equations, until it meets something opaque or leaves
// the scene; that is lit like a first hit. See onward_rays-inl.h.
#pragma once

#include "renderer/lighting/reflections-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// What follows light through glass behind first hits [0, count) may spend. Counted by surfaces, not by
// packets, whose gaps depend on their width.
HWY_NOINLINE inline void set_ray_budget(const TileJob& job, int count) {
  const HitBatch& hits = job.scratch->first;
  int surfaces = 0;
  for (int slot = 0; slot < count; slot += kLanes) {
    const MF surface = hn::Or(of_kind(hits, slot, HitKind::object), of_kind(hits, slot, HitKind::catcher));
    surfaces += static_cast<int>(hn::CountTrue(kF, surface));
  }
  job.scratch->second->pending->budget = kMostGlassRays * surfaces;
}

// Puts the refracted rays of first hits [0, count) into the queue, and those reflected totally, where no
// mirror rays are traced.
HWY_NOINLINE inline void queue_refractions(const TileJob& job, int count) {
  const FramePlan& plan = *job.shading->plan;
  const HitBatch& hits = job.scratch->first;
  PendingRays& pending = *job.scratch->second->pending;
  const VF one = set(1.0f);
  for (const bool mirrored_rays : {false, true}) {
    if (mirrored_rays && plan.mirror_rays) break;
    for (int slot = 0; slot < count; slot += kLanes) {
      const MF clear_hits =
          hn::And(of_kind(hits, slot, HitKind::object), hn::Gt(load(&hits.transmission[slot]), hn::Zero(kF)));
      if (hn::AllFalse(kF, clear_hits)) continue;
      const Onward onward =
          onward_from(plan, hits, slot, {one, one, one}, first_lanes(0), kNegligibleWeight, false);
      const VI path = hn::Add(hn::Iota(kI, 0), hn::Set(kI, slot + kFirstCode));
      if (mirrored_rays) {
        const V3 medium = only(onward.at.inside, load3(hits.absorption, slot));
        push_back(pending, hits, slot, onward, medium, path, onward.sends_back);
      } else {
        push_through(pending, hits, slot, onward, path, onward.sends_through);
      }
    }
  }
}

// The whole stage for first hits [0, count).
template <SurfaceDetail kDetail, Lobe kLobe>
HWY_NOINLINE void refract_light(const TileJob& job, int count) {
  queue_refractions(job, count);
  follow_rays<kDetail, kLobe>(job);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
