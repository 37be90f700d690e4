// Shadow rays: from hits of a batch to points of a light, compacted into dense packets, traced for occlusion.
// Hits that face away are culled first; rays of neighbouring hits to the same stratum share packets.
#pragma once

#include "renderer/tiles/lanes-inl.h"
#include "renderer/tiles/ray_packets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

HWY_INLINE MF of_kind(const HitBatch& hits, int slot, HitKind kind) {
  return hn::RebindMask(kF,
                        hn::Eq(hn::Load(kI, &hits.kind[slot]), hn::Set(kI, static_cast<std::int32_t>(kind))));
}

// The way from each hit to the point that light sample `s` of it aims at, not normalised: to the centre of
// the light, or to a jittered place in one stratum, or to its middle. A sun's lies outside the scene.
HWY_INLINE V3 way_to_light(const LightRecord& light, int s, const HitBatch& hits, int slot) {
  if (light.kind == LightKind::sun) {
    return scale(set3(light.direction), set(-light.reach));
  }
  const V3 p = load3(hits.position, slot);
  if (light.samples == 1) return sub(set3(light.centre), p);
  const VU key = hn::Load(kU, &hits.key[slot]);
  const int nx = light.strata[0], ny = light.strata[1];
  const int cell[3] = {s % nx, s / nx % ny, s / (nx * ny)};
  VF point[3];
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t number = light.key + 3 * static_cast<std::uint32_t>(s) + axis;
    const VF jitter = light.in_middles ? set(0.5f) : unit_float(hash(key, number));
    const float width =
        light.stratified ? light.size[axis] / static_cast<float>(light.strata[axis]) : light.size[axis];
    const float lower =
        light.stratified ? light.lower[axis] + width * static_cast<float>(cell[axis]) : light.lower[axis];
    point[axis] = hn::MulAdd(jitter, set(width), set(lower));
  }
  return sub(V3{point[0], point[1], point[2]}, p);
}

// Hits of [slot, slot + kLanes) that can receive light from `to_light`.
HWY_INLINE MF facing(const HitBatch& hits, int slot, const V3& to_light) {
  const MF surface = hn::Or(of_kind(hits, slot, HitKind::object), of_kind(hits, slot, HitKind::catcher));
  const VF by_shading = dot(load3(hits.normal, slot), to_light);
  const VF by_geometry = dot(load3(hits.geometric_normal, slot), to_light);
  return hn::And(surface, hn::Gt(hn::Min(by_shading, by_geometry), hn::Zero(kF)));
}

// Where secondary rays of hits [slot, slot + kLanes) start, on the viewer's side of the surface.
HWY_INLINE V3 ray_origin(const HitBatch& hits, int slot) {
  return mul_add(load(&hits.offset[slot]), load3(hits.geometric_normal, slot), load3(hits.position, slot));
}

// An empty queue for rays to light sample `s`, or for occlusion ray `s`.
HWY_INLINE void begin_light_rays(RayQueue& queue, const LightRecord& light, int s) {
  constexpr std::uint32_t kShadows = 1u << 19;  // beyond the light's own numbers
  queue.count = 0;
  queue.salt = light.key + kShadows + static_cast<std::uint32_t>(s);
}
HWY_INLINE void begin_occlusion_rays(RayQueue& queue, int s) {
  constexpr std::uint32_t kOcclusion = 1u << 18;  // between the first light's numbers and its shadows
  queue.count = 0;
  queue.salt = kOcclusion + static_cast<std::uint32_t>(s);
}

// Appends `lanes` to the queue. Compressed in a register and stored whole: a compressing store is microcoded
// on some CPUs. What the store writes beyond the last ray is overwritten by the next.
HWY_INLINE void push(RayQueue& queue, const V3& origin, const V3& direction, VI hit, MF lanes) {
  const int at = queue.count;
  const auto put = [&](const V3& value, Lane3& to) HWY_ATTR {
    hn::StoreU(hn::Compress(value.x, lanes), kF, to.x.data() + at);
    hn::StoreU(hn::Compress(value.y, lanes), kF, to.y.data() + at);
    hn::StoreU(hn::Compress(value.z, lanes), kF, to.z.data() + at);
  };
  put(origin, queue.origin);
  put(direction, queue.direction);
  hn::StoreU(hn::Compress(hit, hn::RebindMask(kI, lanes)), kI, queue.hit.data() + at);
  queue.count += static_cast<int>(hn::CountTrue(kF, lanes));
}

// Appends the shadow rays of `lanes`, from the hits' ray origins to where `to_light` leads.
HWY_INLINE void push_shadow_rays(RayQueue& queue, const HitBatch& hits, int slot, const V3& to_light,
                                 MF lanes) {
  if (hn::AllFalse(kF, lanes)) return;
  const V3 g = load3(hits.geometric_normal, slot);
  const V3 direction = mul_add(hn::Neg(load(&hits.offset[slot])), g, to_light);
  push(queue, ray_origin(hits, slot), direction, hn::Add(hn::Iota(kI, 0), hn::Set(kI, slot)), lanes);
}

// Appends ray `i` of another queue.
HWY_INLINE void push_one(RayQueue& queue, const RayQueue& from, int i) {
  const auto at = static_cast<std::size_t>(i), to = static_cast<std::size_t>(queue.count++);
  for (Lane<float> Lane3::*axis : {&Lane3::x, &Lane3::y, &Lane3::z}) {
    (queue.origin.*axis)[to] = (from.origin.*axis)[at];
    (queue.direction.*axis)[to] = (from.direction.*axis)[at];
  }
  queue.hit[to] = from.hit[at];
}

// Finds which of a packet's rays meet something. Blended surfaces stop none: `passes` is the share of light
// that goes past them, and such rays count as blocked where it is negligible.
HWY_INLINE MF occluded_by_shares(const int* valid, RTCScene scene, MF lanes, Ray& packet, VF& passes) {
  PassingContext passing;
  for (float& share : passing.passes) share = 1.0f;
  const VU lane = hn::BitCast(kU, hn::Iota(kI, 0));
  hn::Store(hn::Or(hn::ShiftLeft<kLaneShift>(lane), hn::Set(kU, kPassesThrough)), kU, packet.flags);
  passing_packet<kLanes>(valid, scene, &packet, passing);
  passes = loadu(passing.passes);
  const MF hit = hn::Or(hn::Lt(load(packet.tfar), hn::Zero(kF)), hn::Lt(passes, set(1.0f / 512.0f)));
  return hn::And(lanes, hit);
}

// With voxels: rays of the queue from `start` on are as wide as those that found the hits they come from, and
// have random numbers of their own.
HWY_INLINE void widen_shadow_rays(Ray& packet, const HitBatch& hits, const RayQueue& queue, int start,
                                  const V3& direction, MF used) {
  const VI hit = hn::IfThenElseZero(hn::RebindMask(kI, used), hn::LoadU(kI, &queue.hit[start]));
  const VF length = hn::Sqrt(hn::Max(dot(direction, direction), set(1e-30f)));
  const VF width = hn::Max(hn::GatherIndex(kF, hits.cone_width.data(), hit), hn::Zero(kF));
  hn::Store(footprint_code(hn::Div(width, length), hn::Zero(kF)), kU, packet.id);
  const VI key = hn::GatherIndex(kI, reinterpret_cast<const std::int32_t*>(hits.key.data()), hit);
  set_chance(packet, hash(hn::BitCast(kU, key), queue.salt));
}

// Traces the queue's rays over their whole length, t in [0, 1); calls blocked(i, passes) for each that meets
// something of `mask`: the share of light that passes is 0, or more behind blended surfaces.
template <typename Blocked>
HWY_INLINE void trace_occlusion(const TileJob& job, const HitBatch& hits, const RayQueue& queue,
                                unsigned mask, RayKind kind, const Blocked& blocked) {
  alignas(64) Ray packet;
  alignas(64) int valid[kMaxLanes];
  job.counters->rays[kind] += queue.count;
  for (int start = 0; start < queue.count; start += kLanes) {
    const MF used = first_lanes(queue.count - start);
    const V3 origin = load3(queue.origin, start);
    const V3 direction = load3(queue.direction, start);
    const MF lanes = hn::And(used, traceable(origin, direction));
    job.counters->invalid_rays +=
        static_cast<std::int64_t>(hn::CountTrue(kF, used) - hn::CountTrue(kF, lanes));
    set_rays(packet, origin, direction, kShadowRayEnd, mask);
    if (job.shading->plan->voxels) widen_shadow_rays(packet, hits, queue, start, direction, used);
    set_valid(valid, lanes);
    record(job, kind, packet, valid, false);
    VF passes = set(1.0f);
    MF hit;
    if (job.shading->plan->alpha_blend) {
      hit = occluded_by_shares(valid, job.shading->scene, lanes, packet, passes);
      passes = hn::IfThenZeroElse(hit, passes);
      hit = hn::Or(hit, hn::And(lanes, hn::Lt(passes, set(1.0f))));
    } else {
      occluded_packet<kLanes>(valid, job.shading->scene, &packet);
      // Embree sets tfar to -inf where something is in the way.
      hit = hn::And(lanes, hn::Lt(load(packet.tfar), hn::Zero(kF)));
      passes = hn::Zero(kF);
    }
    if (hn::AllFalse(kF, hit)) continue;
    alignas(64) int hit_lane[kMaxLanes];
    alignas(64) float share[kMaxLanes];
    hn::Store(hn::VecFromMask(kI, hn::RebindMask(kI, hit)), kI, hit_lane);
    hn::Store(passes, kF, share);
    for (int i = 0; i < kLanes; ++i) {
      if (hit_lane[i] != 0) blocked(start + i, share[i]);
    }
  }
}

// Traces the queue's rays against everything, and those of catchers that are blocked against catchers alone:
// what blocks a catcher may be another catcher, which is there without the virtual objects too. What is not
// there without them (`real` = false) is asked for once only. Calls blocked(hit, passes) and
// blocked_without(hit, passes).
template <typename Blocked, typename BlockedWithout>
HWY_INLINE void trace_visibility(const TileJob& job, const HitBatch& hits, bool real, RayKind kind,
                                 RayKind catcher_kind, const Blocked& blocked,
                                 const BlockedWithout& blocked_without) {
  TileScratch& scratch = *job.scratch;
  const bool catchers_occlude = job.shading->plan->catchers_occlude && real;
  if (catchers_occlude) scratch.blocked->count = 0, scratch.blocked->salt = scratch.queue.salt;
  // Probes of catchers alone know no virtual object.
  const unsigned mask = kind == RayKind::catcher_probe_shadow ? kCatcherMask : kAllMask;
  trace_occlusion(job, hits, scratch.queue, mask, kind, [&](int i, float passes) HWY_ATTR {
    const auto hit = static_cast<std::size_t>(scratch.queue.hit[static_cast<std::size_t>(i)]);
    blocked(hit, passes);
    if (!catchers_occlude || hits.kind[hit] != static_cast<int>(HitKind::catcher)) return;
    push_one(*scratch.blocked, scratch.queue, i);
  });
  if (!catchers_occlude || scratch.blocked->count == 0) return;
  trace_occlusion(job, hits, *scratch.blocked, kCatcherMask, catcher_kind, [&](int i, float passes) HWY_ATTR {
    blocked_without(static_cast<std::size_t>(scratch.blocked->hit[static_cast<std::size_t>(i)]), passes);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
