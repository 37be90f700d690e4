// One sample of a light at the hits of a batch: its shadow rays, and its light where they pass.
#pragma once

#include "renderer/lighting/reflectance-inl.h"
#include "renderer/lighting/shadow_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Irradiance per unit of intensity and cosine: 1 / max(d^2, r^2), times a spot's cone and the end of its
// range (KHR_lights_punctual). `direction` is towards the light, unit. A sun is equally bright everywhere.
HWY_INLINE VF falloff(const LightRecord& light, VF distance2, const V3& direction) {
  const VF zero = hn::Zero(kF), one = set(1.0f);
  if (light.kind == LightKind::sun) return one;
  VF value = hn::Div(one, hn::Max(distance2, set(light.min_distance2)));
  if (light.kind == LightKind::spot) {
    const VF cosine = hn::Neg(dot(set3(light.direction), direction));
    const VF cone =
        hn::Min(hn::Max(hn::MulAdd(cosine, set(light.cone_scale), set(light.cone_offset)), zero), one);
    value = hn::Mul(value, hn::Mul(cone, cone));
  }
  if (light.inverse_range2 > 0) {
    const VF share = hn::Mul(distance2, set(light.inverse_range2));
    value = hn::Mul(value, hn::Max(hn::NegMulAdd(share, share, one), zero));
  }
  return value;
}

// Adds one light sample, with the visibility found by tracing.
template <Lobe kLobe>
HWY_INLINE void add_sample(const TileJob& job, const LightRecord& light, int s, HitBatch& hits, int slot) {
  const TileScratch& scratch = *job.scratch;
  const V3 to_light = way_to_light(light, s, hits, slot);
  const VF visible = load(&scratch.visible[slot]);
  const VF counts =
      job.shading->plan->catchers ? hn::Max(visible, load(&scratch.visible_without[slot])) : visible;
  const MF lit = hn::And(facing(hits, slot, to_light), hn::Gt(counts, hn::Zero(kF)));
  if (hn::AllFalse(kF, lit)) return;
  const VF distance2 = hn::Max(dot(to_light, to_light), set(1e-36f));
  const VF per_distance = hn::Div(set(1.0f), hn::Sqrt(distance2));
  const V3 direction = scale(to_light, per_distance);
  const V3 n = load3(hits.normal, slot);
  const VF n_l = hn::Max(dot(n, direction), hn::Zero(kF));
  const VF share =
      hn::Mul(set(1.0f / static_cast<float>(light.samples)), falloff(light, distance2, direction));
  const VF geometry = hn::IfThenElseZero(lit, hn::Mul(n_l, share));
  const VF seen = hn::Mul(geometry, visible);
  const VF turn = hn::Mul(per_distance, set(light.half_turn_m));
  V3 f = reflectance<kLobe>(hits, slot, n, direction, n_l, hn::Mul(turn, turn));
  if (job.shading->plan->catchers) {
    // On a catcher the sum is irradiance itself, twice: with the virtual objects and without.
    const MF catcher = of_kind(hits, slot, HitKind::catcher);
    if (!hn::AllFalse(kF, catcher)) {
      const VF one = set(1.0f);
      f = select(catcher, V3{one, one, one}, f);
      const VF alone = hn::Mul(geometry, load(&scratch.visible_without[slot]));
      add_to(hits.direct_without, slot, scale(set3(light.intensity), alone));
    }
  }
  const V3 arrives = scale(set3(light.intensity), seen);
  add_to(hits.direct, slot, {hn::Mul(arrives.x, f.x), hn::Mul(arrives.y, f.y), hn::Mul(arrives.z, f.z)});
}

// Queues one shadow ray for each hit that faces sample `s`, and assumes it visible.
HWY_NOINLINE inline void queue_shadow_rays(const TileJob& job, const LightRecord& light, int s,
                                           const HitBatch& hits, int count) {
  TileScratch& scratch = *job.scratch;
  scratch.queue.count = 0;
  for (int slot = 0; slot < count; slot += kLanes) {
    const V3 to_light = way_to_light(light, s, hits, slot);
    hn::Store(set(1.0f), kF, &scratch.visible[slot]);
    hn::Store(set(1.0f), kF, &scratch.visible_without[slot]);
    push_shadow_rays(scratch.queue, hits, slot, to_light, facing(hits, slot, to_light));
  }
}

HWY_NOINLINE inline void find_visibility(const TileJob& job, const HitBatch& hits, RayKind kind) {
  TileScratch& scratch = *job.scratch;
  trace_visibility(
      job, hits, kind, RayKind::catcher_shadow,
      [&](std::size_t hit, float passes) { scratch.visible[hit] = passes; },
      [&](std::size_t hit, float passes) { scratch.visible_without[hit] = passes; });
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
