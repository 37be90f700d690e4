// The surfaces that packets of rays from the eye meet, backs of single-sided ones left out. Most meshes that
// face outwards never show their backs, so Embree asks no filter at their hits: where a back is met all the
// same (the eye is inside, parts overlap, a bent mesh has turned over), the ray goes on from there.
// Before: first hits are traced. After: they are lit.
#pragma once

#include "renderer/surfaces/surfaces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Traces `backs` of a packet again, from behind what they hit.
HWY_NOINLINE inline void pass_backs(const TileJob& job, RayHit& packet, MF backs) {
  alignas(64) int valid[kMaxLanes];
  set_valid(valid, backs);
  // Rays end before they begin again, and never at 0: eight numbers after t. Embree compares T and tnear
  // times the determinant, and tells T times its rounded reciprocal: with AVX2 up to two numbers before the
  // next one, so that the same back would be met for ever.
  const VF t = load(packet.ray.tfar);
  const VF next = hn::BitCast(kF, hn::Add(hn::BitCast(kU, t), hn::Set(kU, 8u)));
  const auto put = [&](VF value, float* lane) HWY_ATTR { store_lanes(value, backs, lane); };
  put(hn::Max(next, set(1e-30f)), packet.ray.tnear);
  put(set(kEndless), packet.ray.tfar);
  const VU nothing = hn::Set(kU, RTC_INVALID_GEOMETRY_ID);
  const auto clear_id = [&](unsigned* lane) HWY_ATTR {
    const VU kept = hn::Load(kU, lane);
    hn::Store(hn::IfThenElse(hn::RebindMask(kU, backs), nothing, kept), kU, lane);
  };
  clear_id(packet.hit.geomID);
  clear_id(packet.hit.instID[0]);
  job.counters->rays[RayKind::behind] += static_cast<std::int64_t>(hn::CountTrue(kF, backs));
  record(job, RayKind::behind, packet.ray, valid, true);
  intersect_packet<kLanes>(valid, job.shading->scene, true, &packet);
}

// Traced packet `p` -> its lanes of the first hits.
template <SurfaceDetail kDetail>
HWY_INLINE void surface_seen(const TileJob& job, int p, MF traced) {
  TileScratch& scratch = *job.scratch;
  RayHit& packet = packets_of(scratch)[p];
  const int slot = p * kLanes;
  const VF width = load(&scratch.first.cone_width[slot]);
  for (;;) {
    const MF backs = surface_of_packet<kDetail>(packet, traced, *job.shading, false, scratch.first, slot);
    if (!job.shading->plan->back_face_culling || hn::AllFalse(kF, backs)) return;
    job.cycles->lap(Stage::surfaces);
    pass_backs(job, packet, backs);
    job.cycles->lap(Stage::first_hits);
    hn::Store(width, kF, &scratch.first.cone_width[slot]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
