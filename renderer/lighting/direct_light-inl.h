// Stage: light rays. Direct light of every light at the hits of a batch: N stratified samples per light,
// E = (I / N) sum V cos(theta) / max(d^2, r^2), diffuse and specular.
#if defined(HERR_DIRECT_LIGHT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HERR_DIRECT_LIGHT_INL
#undef HERR_DIRECT_LIGHT_INL
#else
#define HERR_DIRECT_LIGHT_INL
#endif

#include <cstring>

#include "renderer/lighting/reflectance-inl.h"
#include "renderer/lighting/shadow_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

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
        job.counters->rays[RayKind::catcher_shadow] += scratch.blocked.count;
      }
      for (int slot = 0; slot < count; slot += kLanes) add_sample<kSpecular>(job, light, s, hits, slot);
      job.counters->rays[kind] += scratch.queue.count;
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();

#endif
