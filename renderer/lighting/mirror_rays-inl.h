// Stage: second rays. One mirror bounce for hits whose material asks for it; rays are compacted into dense
// packets, their surfaces lit like first hits, and the result is added to the hit that sent them.
#if defined(HERR_MIRROR_RAYS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HERR_MIRROR_RAYS_INL
#undef HERR_MIRROR_RAYS_INL
#else
#define HERR_MIRROR_RAYS_INL
#endif

#include "renderer/lighting/direct_light-inl.h"
#include "renderer/lighting/outgoing-inl.h"
#include "renderer/lighting/surfaces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// A mirror share below half an 8-bit step of white cannot be seen: no ray is traced for it.
constexpr float kNegligibleReflection = 1.0f / 512.0f;

// Share of the mirror ray that is seen, per channel: mirror * (F0 + (1 - F0) (1 - n.v)^5).
HWY_INLINE V3 mirror_weight(const HitBatch& hits, int slot) {
  const VF one = set(1.0f);
  const V3 n = load3(&hits.nx[slot], &hits.ny[slot], &hits.nz[slot]);
  const V3 v = load3(&hits.vx[slot], &hits.vy[slot], &hits.vz[slot]);
  const VF k = hn::Sub(one, hn::Min(hn::Max(dot(n, v), hn::Zero(kF)), one));
  const VF k2 = hn::Mul(k, k), grazing = hn::Mul(hn::Mul(k2, k2), k), mirror = load(&hits.mirror[slot]);
  const auto channel = [&](const Lane<float>& f0_lane) HWY_ATTR {
    const VF f0 = load(&f0_lane[slot]);
    return hn::Mul(mirror, hn::MulAdd(grazing, hn::Sub(one, f0), f0));
  };
  return {channel(hits.fr), channel(hits.fg), channel(hits.fb)};
}

HWY_INLINE void queue_mirror_rays(TileScratch& scratch, int count) {
  const HitBatch& hits = scratch.first;
  RayQueue& queue = scratch.queue;
  queue.count = 0;
  const VI lane = hn::Iota(kI, 0);
  for (int slot = 0; slot < count; slot += kLanes) {
    const MF object = hn::RebindMask(
        kF, hn::Eq(hn::Load(kI, &hits.kind[slot]), hn::Set(kI, static_cast<int>(HitKind::object))));
    if (hn::AllFalse(kF, object)) continue;
    const V3 weight = mirror_weight(hits, slot);
    const VF strongest = hn::Max(weight.x, hn::Max(weight.y, weight.z));
    const MF reflects = hn::And(object, hn::Gt(strongest, set(kNegligibleReflection)));
    if (hn::AllFalse(kF, reflects)) continue;
    hn::Store(weight.x, kF, &scratch.mirror_r[slot]);
    hn::Store(weight.y, kF, &scratch.mirror_g[slot]);
    hn::Store(weight.z, kF, &scratch.mirror_b[slot]);
    const V3 v = load3(&hits.vx[slot], &hits.vy[slot], &hits.vz[slot]);
    const V3 n = load3(&hits.nx[slot], &hits.ny[slot], &hits.nz[slot]);
    const V3 g = load3(&hits.gx[slot], &hits.gy[slot], &hits.gz[slot]);
    const auto reflect = [&](const V3& normal) HWY_ATTR {
      return mul_add(hn::Mul(set(2.0f), dot(normal, v)), normal, scale(v, set(-1.0f)));
    };
    // An interpolated normal can send the ray into the surface; the triangle's own normal never does.
    const V3 bent = reflect(n);
    const V3 direction = select(hn::Gt(dot(bent, g), hn::Zero(kF)), bent, reflect(g));
    const V3 p = load3(&hits.px[slot], &hits.py[slot], &hits.pz[slot]);
    push(queue, mul_add(load(&hits.offset[slot]), g, p), direction, hn::Add(lane, hn::Set(kI, slot)),
         reflects);
  }
}

// Traces the queued rays and stores their surfaces in the second batch, slot i for ray i.
template <bool kTextures>
HWY_INLINE void trace_mirror_rays(const TileJob& job) {
  TileScratch& scratch = *job.scratch;
  const RayQueue& queue = scratch.queue;
  RayHit& packet = packets_of(scratch)[0];  // the first hits are done with
  alignas(64) int valid[kMaxLanes];
  for (int start = 0; start < queue.count; start += kLanes) {
    const MF used = first_lanes(queue.count - start);
    const V3 origin = load3(&queue.ox[start], &queue.oy[start], &queue.oz[start]);
    const V3 direction = load3(&queue.dx[start], &queue.dy[start], &queue.dz[start]);
    const MF lanes = hn::And(used, traceable(origin, direction));
    job.counters->rays[RayKind::mirror] += static_cast<std::int64_t>(hn::CountTrue(kF, lanes));
    job.counters->invalid_rays +=
        static_cast<std::int64_t>(hn::CountTrue(kF, used) - hn::CountTrue(kF, lanes));
    set_rays(packet, origin, direction);
    set_valid(valid, lanes);
    record(job, RayKind::mirror, packet.ray, valid, false);
    intersect_packet<kLanes>(valid, job.shading->scene, true, &packet);
    surface_of_packet<kTextures>(packet, lanes, *job.shading, true, scratch.second, start);
    // A mirrored hit draws other random numbers than the hit that sent it.
    const VI hit = hn::IfThenElseZero(hn::RebindMask(kI, used), hn::LoadU(kI, &queue.hit[start]));
    const VU key = hn::BitCast(
        kU, hn::GatherIndex(kI, reinterpret_cast<const std::int32_t*>(scratch.first.key.data()), hit));
    hn::Store(hash(key, 0x517cc1b7u), kU, &scratch.second.key[start]);
  }
}

// Adds what mirror rays [0, rays) brought to the first hits' light.
HWY_INLINE void gather_mirror_light(const TileJob& job, int rays) {
  TileScratch& scratch = *job.scratch;
  HitBatch& first = scratch.first;
  const HitBatch& second = scratch.second;
  const V3 environment = set3(job.shading->environment);
  alignas(64) float r[kMaxLanes], g[kMaxLanes], b[kMaxLanes];
  for (int start = 0; start < rays; start += kLanes) {
    const MF object = hn::RebindMask(
        kF, hn::Eq(hn::Load(kI, &second.kind[start]), hn::Set(kI, static_cast<int>(HitKind::object))));
    const V3 radiance = select(object, outgoing(second, start, *job.shading, false), environment);
    hn::Store(radiance.x, kF, r);
    hn::Store(radiance.y, kF, g);
    hn::Store(radiance.z, kF, b);
    const int lanes = rays - start < kLanes ? rays - start : kLanes;
    for (int i = 0; i < lanes; ++i) {
      const auto hit = static_cast<std::size_t>(scratch.mirror_sender[static_cast<std::size_t>(start + i)]);
      first.lr[hit] += scratch.mirror_r[hit] * r[i];
      first.lg[hit] += scratch.mirror_g[hit] * g[i];
      first.lb[hit] += scratch.mirror_b[hit] * b[i];
    }
  }
}

// The whole stage for first hits [0, count).
template <bool kTextures, bool kSpecular>
HWY_INLINE void reflect_light(const TileJob& job, int count) {
  TileScratch& scratch = *job.scratch;
  queue_mirror_rays(scratch, count);
  const int rays = scratch.queue.count;
  if (rays == 0) return;
  std::memcpy(scratch.mirror_sender.data(), scratch.queue.hit.data(),
              sizeof(std::int32_t) * static_cast<std::size_t>(rays));
  trace_mirror_rays<kTextures>(job);
  job.cycles->lap(Stage::second_hits);
  direct_light<kSpecular>(job, scratch.second, rays, RayKind::mirror_shadow);
  gather_mirror_light(job, rays);
  job.cycles->lap(Stage::second_light);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();

#endif
