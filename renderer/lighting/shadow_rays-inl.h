// Shadow rays: from hits of a batch to points of a light, compacted into dense packets, traced for occlusion.
// Hits that face away are culled first; rays of neighbouring hits to the same stratum share packets.
#if defined(HERR_SHADOW_RAYS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HERR_SHADOW_RAYS_INL
#undef HERR_SHADOW_RAYS_INL
#else
#define HERR_SHADOW_RAYS_INL
#endif

#include "renderer/lighting/ray_packets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// The point of the light that sample `s` of each hit aims at: the centre, or a jittered place in stratum s.
HWY_INLINE V3 light_point(const LightRecord& light, bool many, int s, VU key) {
  if (!many) return set3(light.centre);
  const int nx = light.strata[0], ny = light.strata[1];
  const int cell[3] = {s % nx, s / nx % ny, s / (nx * ny)};
  VF point[3];
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const VF jitter = unit_float(hash(key, light.key + 3 * static_cast<std::uint32_t>(s) + axis));
    const float width = light.size[axis] / static_cast<float>(light.strata[axis]);
    const float lower = light.lower[axis] + width * static_cast<float>(cell[axis]);
    point[axis] = hn::MulAdd(jitter, set(width), set(lower));
  }
  return {point[0], point[1], point[2]};
}

// Hits of [slot, slot + kLanes) that can receive light from `point`; `to_light` is not normalised.
HWY_INLINE MF facing(const HitBatch& hits, int slot, const V3& point, V3& to_light) {
  const V3 p = load3(&hits.px[slot], &hits.py[slot], &hits.pz[slot]);
  to_light = sub(point, p);
  const VI kind = hn::Load(kI, &hits.kind[slot]);
  const MF surface =
      hn::RebindMask(kF, hn::Or(hn::Eq(kind, hn::Set(kI, static_cast<int>(HitKind::object))),
                                hn::Eq(kind, hn::Set(kI, static_cast<int>(HitKind::catcher)))));
  const VF by_shading = dot(load3(&hits.nx[slot], &hits.ny[slot], &hits.nz[slot]), to_light);
  const VF by_geometry = dot(load3(&hits.gx[slot], &hits.gy[slot], &hits.gz[slot]), to_light);
  return hn::And(surface, hn::Gt(hn::Min(by_shading, by_geometry), hn::Zero(kF)));
}

// Appends `lanes` to the queue. Compressed in a register and stored whole: a compressing store is microcoded
// on some CPUs. What the store writes beyond the last ray is overwritten by the next.
HWY_INLINE void push(RayQueue& queue, const V3& origin, const V3& direction, VI hit, MF lanes) {
  const int at = queue.count;
  const auto put = [&](VF value, Lane<float>& lane)
                       HWY_ATTR { hn::StoreU(hn::Compress(value, lanes), kF, lane.data() + at); };
  put(origin.x, queue.ox);
  put(origin.y, queue.oy);
  put(origin.z, queue.oz);
  put(direction.x, queue.dx);
  put(direction.y, queue.dy);
  put(direction.z, queue.dz);
  hn::StoreU(hn::Compress(hit, hn::RebindMask(kI, lanes)), kI, queue.hit.data() + at);
  queue.count += static_cast<int>(hn::CountTrue(kF, lanes));
}

// Traces the queue's rays over their whole length; calls blocked(i) for each that meets something of `mask`.
template <typename Blocked>
HWY_INLINE void trace_occlusion(const TileJob& job, const RayQueue& queue, unsigned mask, RayKind kind,
                                const Blocked& blocked) {
  alignas(64) Ray packet;
  alignas(64) int valid[kMaxLanes];
  for (int start = 0; start < queue.count; start += kLanes) {
    const MF used = first_lanes(queue.count - start);
    const V3 origin = load3(&queue.ox[start], &queue.oy[start], &queue.oz[start]);
    const V3 direction = load3(&queue.dx[start], &queue.dy[start], &queue.dz[start]);
    const MF lanes = hn::And(used, traceable(origin, direction));
    job.counters->invalid_rays +=
        static_cast<std::int64_t>(hn::CountTrue(kF, used) - hn::CountTrue(kF, lanes));
    set_rays(packet, origin, direction, kShadowRayEnd, mask);
    set_valid(valid, lanes);
    record(job, kind, packet, valid, false);
    occluded_packet<kLanes>(valid, job.shading->scene, &packet);
    // Embree sets tfar to -inf where something is in the way.
    const MF hit = hn::And(lanes, hn::Lt(load(packet.tfar), hn::Zero(kF)));
    if (hn::AllFalse(kF, hit)) continue;
    alignas(64) int hit_lane[kMaxLanes];
    hn::Store(hn::VecFromMask(kI, hn::RebindMask(kI, hit)), kI, hit_lane);
    for (int i = 0; i < kLanes; ++i) {
      if (hit_lane[i] != 0) blocked(start + i);
    }
  }
}

// Fills the queue with one shadow ray for each hit that faces sample `s`, and assumes it visible.
HWY_INLINE void queue_shadow_rays(const TileJob& job, const LightRecord& light, int s, const HitBatch& hits,
                                  int count) {
  TileScratch& scratch = *job.scratch;
  scratch.queue.count = 0;
  const VI lane = hn::Iota(kI, 0);
  for (int slot = 0; slot < count; slot += kLanes) {
    V3 to_light;
    const V3 point =
        light_point(light, job.shading->plan->many_light_samples, s, hn::Load(kU, &hits.key[slot]));
    const MF lit = facing(hits, slot, point, to_light);
    hn::Store(set(1.0f), kF, &scratch.visible[slot]);
    hn::Store(set(1.0f), kF, &scratch.visible_without[slot]);
    if (hn::AllFalse(kF, lit)) continue;
    const V3 p = load3(&hits.px[slot], &hits.py[slot], &hits.pz[slot]);
    const V3 g = load3(&hits.gx[slot], &hits.gy[slot], &hits.gz[slot]);
    const V3 origin = mul_add(load(&hits.offset[slot]), g, p);
    push(scratch.queue, origin, sub(point, origin), hn::Add(lane, hn::Set(kI, slot)), lit);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();

#endif
