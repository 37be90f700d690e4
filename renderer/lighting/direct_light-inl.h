// Stage: light rays. Direct light of box lights at every hit of a batch: N stratified samples per light,
// E = (I / N) sum V cos(theta) / max(d^2, r^2), diffuse and GGX specular (Walter et al. 2007; visibility term
// by Hammon 2017). Hits that face away are culled first; shadow rays of neighbouring hits share packets.
#if defined(HERR_DIRECT_LIGHT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HERR_DIRECT_LIGHT_INL
#undef HERR_DIRECT_LIGHT_INL
#else
#define HERR_DIRECT_LIGHT_INL
#endif

#include <cstring>

#include "renderer/lighting/ray_packets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

constexpr float kInvPi = 0.318309886f;

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

// Outgoing radiance per unit of irradiance along the light's direction: Lambert plus GGX.
template <bool kSpecular>
HWY_INLINE V3 reflectance(const HitBatch& hits, int slot, const V3& n, const V3& light, VF n_l) {
  const VF inv_pi = set(kInvPi);
  V3 f{hn::Mul(load(&hits.dr[slot]), inv_pi), hn::Mul(load(&hits.dg[slot]), inv_pi),
       hn::Mul(load(&hits.db[slot]), inv_pi)};
  if constexpr (kSpecular) {
    const VF one = set(1.0f), tiny = set(1e-8f);
    const V3 v = load3(&hits.vx[slot], &hits.vy[slot], &hits.vz[slot]);
    const V3 h = normalise(V3{hn::Add(light.x, v.x), hn::Add(light.y, v.y), hn::Add(light.z, v.z)});
    const VF n_v = hn::Max(hn::Abs(dot(n, v)), set(1e-4f));
    const VF n_h = dot(n, h);
    const VF l_h = hn::Max(dot(light, h), hn::Zero(kF));
    const VF alpha2 = load(&hits.alpha2[slot]);
    // |n x h|^2 instead of 1 - (n.h)^2: no cancellation at the peak of a smooth surface.
    const V3 c = cross(n, h);
    const VF spread = hn::Max(hn::MulAdd(hn::Mul(alpha2, n_h), n_h, dot(c, c)), tiny);
    const VF lobe = hn::Div(hn::Mul(alpha2, inv_pi), hn::Mul(spread, spread));
    const VF alpha = hn::Sqrt(alpha2);
    const VF smooth_view = hn::Mul(set(2.0f), hn::Mul(n_l, n_v));
    const VF shadowing = hn::Div(
        set(0.5f), hn::Max(hn::MulAdd(alpha, hn::Sub(hn::Add(n_l, n_v), smooth_view), smooth_view), tiny));
    const VF k = hn::Sub(one, l_h), k2 = hn::Mul(k, k);
    const VF grazing = hn::Mul(hn::Mul(k2, k2), k);  // Schlick
    const VF common = hn::Mul(lobe, shadowing);
    const auto add = [&](VF diffuse, const Lane<float>& f0_lane) HWY_ATTR {
      const VF f0 = load(&f0_lane[slot]);
      return hn::MulAdd(common, hn::MulAdd(grazing, hn::Sub(one, f0), f0), diffuse);
    };
    f = {add(f.x, hits.fr), add(f.y, hits.fg), add(f.z, hits.fb)};
  }
  return f;
}

HWY_INLINE void add_to(Lane<float>& lane, int slot, VF value) {
  hn::Store(hn::Add(load(&lane[slot]), value), kF, &lane[slot]);
}

// Adds one light sample, with the visibility found by tracing.
template <bool kSpecular>
HWY_INLINE void add_sample(const TileJob& job, const LightRecord& light, int s, HitBatch& hits, int slot) {
  const TileScratch& scratch = *job.scratch;
  const int samples = job.shading->light_samples;
  V3 to_light;
  const V3 point =
      light_point(light, job.shading->plan->many_light_samples, s, hn::Load(kU, &hits.key[slot]));
  const MF lit = facing(hits, slot, point, to_light);
  if (hn::AllFalse(kF, lit)) return;
  const VF distance2 = hn::Max(dot(to_light, to_light), set(1e-20f));
  const V3 direction = scale(to_light, hn::Div(set(1.0f), hn::Sqrt(distance2)));
  const V3 n = load3(&hits.nx[slot], &hits.ny[slot], &hits.nz[slot]);
  const VF n_l = hn::Max(dot(n, direction), hn::Zero(kF));
  const VF falloff =
      hn::Div(set(1.0f / static_cast<float>(samples)), hn::Max(distance2, set(light.min_distance2)));
  const VF geometry = hn::IfThenElseZero(lit, hn::Mul(n_l, falloff));
  const VF seen = hn::Mul(geometry, load(&scratch.visible[slot]));
  V3 f = reflectance<kSpecular>(hits, slot, n, direction, n_l);
  if (job.shading->plan->catchers) {
    // On a catcher the sum is irradiance itself, twice: with the virtual objects and without.
    const MF catcher = hn::RebindMask(
        kF, hn::Eq(hn::Load(kI, &hits.kind[slot]), hn::Set(kI, static_cast<int>(HitKind::catcher))));
    if (!hn::AllFalse(kF, catcher)) {
      const VF one = set(1.0f);
      f = select(catcher, V3{one, one, one}, f);
      const VF alone = hn::Mul(geometry, load(&scratch.visible_without[slot]));
      add_to(hits.wr, slot, hn::Mul(alone, set(light.intensity[0])));
      add_to(hits.wg, slot, hn::Mul(alone, set(light.intensity[1])));
      add_to(hits.wb, slot, hn::Mul(alone, set(light.intensity[2])));
    }
  }
  add_to(hits.lr, slot, hn::Mul(hn::Mul(seen, set(light.intensity[0])), f.x));
  add_to(hits.lg, slot, hn::Mul(hn::Mul(seen, set(light.intensity[1])), f.y));
  add_to(hits.lb, slot, hn::Mul(hn::Mul(seen, set(light.intensity[2])), f.z));
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

// Direct light of every light at hits [0, count) of a batch.
template <bool kSpecular>
void direct_light(const TileJob& job, HitBatch& hits, int count, RayKind kind) {
  TileScratch& scratch = *job.scratch;
  const FramePlan& plan = *job.shading->plan;
  const std::size_t bytes = sizeof(float) * static_cast<std::size_t>((count + kLanes - 1) / kLanes * kLanes);
  for (Lane<float>* lane : {&hits.lr, &hits.lg, &hits.lb}) std::memset(lane->data(), 0, bytes);
  if (plan.catchers) {
    for (Lane<float>* lane : {&hits.wr, &hits.wg, &hits.wb}) std::memset(lane->data(), 0, bytes);
  }
  for (const LightRecord& light : job.shading->lights) {
    for (int s = 0; s < job.shading->light_samples; ++s) {
      queue_shadow_rays(job, light, s, hits, count);
      scratch.blocked.count = 0;
      trace_occlusion(job, scratch.queue, kAllMask, kind, [&](int i) HWY_ATTR {
        const auto hit = static_cast<std::size_t>(scratch.queue.hit[static_cast<std::size_t>(i)]);
        scratch.visible[hit] = 0.0f;
        if (!plan.catchers_occlude || hits.kind[hit] != static_cast<int>(HitKind::catcher)) return;
        // What blocks a catcher may be another catcher, which is there without the virtual objects too.
        RayQueue& blocked = scratch.blocked;
        const auto from = static_cast<std::size_t>(i), to = static_cast<std::size_t>(blocked.count++);
        blocked.ox[to] = scratch.queue.ox[from], blocked.oy[to] = scratch.queue.oy[from];
        blocked.oz[to] = scratch.queue.oz[from], blocked.dx[to] = scratch.queue.dx[from];
        blocked.dy[to] = scratch.queue.dy[from], blocked.dz[to] = scratch.queue.dz[from];
        blocked.hit[to] = static_cast<std::int32_t>(hit);
      });
      if (scratch.blocked.count > 0) {
        trace_occlusion(job, scratch.blocked, kCatcherMask, RayKind::catcher_shadow, [&](int i) HWY_ATTR {
          const auto hit = static_cast<std::size_t>(scratch.blocked.hit[static_cast<std::size_t>(i)]);
          scratch.visible_without[hit] = 0.0f;
        });
        job.counters->catcher_shadow_rays += scratch.blocked.count;
      }
      for (int slot = 0; slot < count; slot += kLanes) add_sample<kSpecular>(job, light, s, hits, slot);
      (kind == RayKind::shadow ? job.counters->shadow_rays : job.counters->mirror_shadow_rays) +=
          scratch.queue.count;
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();

#endif
