// Blended surfaces, front to back: each layer of nearest hits is lit whole and covers what lies behind by its
// alpha; rays that are not yet covered go on from there. After kMostLayers the next surface counts as opaque.
// Where less than 1/512 would still be seen, nothing more is traced.
#pragma once

#include "renderer/tracing/resolve-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

HWY_NOINLINE inline void begin_layers(const TileJob& job, int packets) {
  AlphaLayers& layers = *job.scratch->layers;
  const int count = packets * kLanes;
  clear(layers.light, count);
  clear(layers.ratio, count);
  for (int slot = 0; slot < count; slot += kLanes) {
    hn::Store(set(1.0f), kF, &layers.through[slot]);
    hn::Store(hn::Load(kI, &job.scratch->first.kind[slot]), kI, &layers.kind[slot]);
  }
}

// Sends `lanes` of a packet on through what they hit; the others have no sample any more.
HWY_INLINE void go_on(const TileJob& job, int packet, MF lanes) {
  TileScratch& scratch = *job.scratch;
  HitBatch& hits = scratch.first;
  const int slot = packet * kLanes;
  const V3 direction = scale(load3(hits.viewer, slot), set(-1.0f));
  const V3 g = load3(hits.geometric_normal, slot);
  const V3 origin = mul_add(hn::Neg(load(&hits.offset[slot])), g, load3(hits.position, slot));
  const MF valid = hn::And(lanes, traceable(origin, direction));
  const auto wanted = static_cast<std::size_t>(hn::CountTrue(kF, lanes)), rays = hn::CountTrue(kF, valid);
  job.counters->rays[RayKind::behind] += static_cast<std::int64_t>(rays);
  job.counters->invalid_rays += static_cast<std::int64_t>(wanted - rays);
  RayHit& rays_behind = packets_of(scratch)[packet];
  const VU chance = hash(hn::BitCast(kU, load(rays_behind.ray.time)), 0);
  set_rays(rays_behind, origin, direction);
  if (job.shading->plan->voxels) set_chance(rays_behind.ray, chance);
  set_valid(scratch.packet_valid[static_cast<std::size_t>(packet)].data(), valid);
  const VI miss = hn::Set(kI, static_cast<int>(HitKind::miss));
  hn::Store(hn::IfThenElseZero(hn::RebindMask(kI, lanes), miss), kI, &hits.kind[slot]);
}

// Adds the layer that was just lit and aims the rays of the next; false where there is none.
HWY_NOINLINE inline bool add_layer(const TileJob& job, int packets, bool last) {
  AlphaLayers& layers = *job.scratch->layers;
  const HitBatch& hits = job.scratch->first;
  bool more = false;
  for (int packet = 0; packet < packets; ++packet) {
    const int slot = packet * kLanes;
    const VI kind = hn::Load(kI, &hits.kind[slot]);
    const MF lanes = hn::RebindMask(kF, hn::Ne(kind, hn::Zero(kI)));
    if (hn::AllFalse(kF, lanes)) continue;
    const Texel texel = surface_texel(job, packet, kind);
    const VF one = set(1.0f), through = load(&layers.through[slot]);
    VF covers = hn::IfThenElse(of_kind(hits, slot, HitKind::object), load(&hits.coverage[slot]), one);
    VF beyond = hn::Mul(through, hn::Sub(one, covers));
    const MF goes_on = last ? first_lanes(0) : hn::And(lanes, hn::Gt(beyond, set(kNegligibleWeight)));
    covers = hn::IfThenElse(goes_on, covers, one);
    beyond = hn::IfThenElseZero(goes_on, beyond);
    const VF weight = hn::IfThenElseZero(lanes, hn::Mul(through, covers));
    store_lanes(mul_add(weight, texel.light, load3(layers.light, slot)), lanes, layers.light, slot);
    store_lanes(mul_add(weight, texel.ratio, load3(layers.ratio, slot)), lanes, layers.ratio, slot);
    store_lanes(beyond, lanes, &layers.through[slot]);
    go_on(job, packet, goes_on);
    more |= !hn::AllFalse(kF, goes_on);
  }
  return more;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
