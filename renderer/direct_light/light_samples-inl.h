// One sample of a light at the hits of a batch: its shadow rays, and its light where they pass.
#pragma once

#include "renderer/direct_light/drawn_highlights-inl.h"
#include "renderer/direct_light/shadow_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// The way from hits to the middle of the stratum that light sample `s` lies in, unit.
HWY_INLINE V3 towards_stratum(const LightRecord& light, int s, const HitBatch& hits, int slot) {
  const int nx = light.strata[0], ny = light.strata[1];
  const int cell[3] = {s % nx, s / nx % ny, s / (nx * ny)};
  float middle[3];
  for (int axis = 0; axis < 3; ++axis) {
    const float width = light.size[axis] / static_cast<float>(light.strata[axis]);
    middle[axis] = light.lower[axis] + width * (static_cast<float>(cell[axis]) + 0.5f);
  }
  return normalise(sub(set3(middle), load3(hits.position, slot)));
}

// Where highlights that are narrower than a stratum see sample `s`: in its middle, with the width of it all
// (highlight_width). Elsewhere in the stratum they would be hit or missed.
template <Lobe kLobe>
HWY_INLINE V3 shining_from(const LightRecord& light, int s, const HitBatch& hits, int slot,
                           const V3& direction, VF sample_turn2) {
  if (kLobe == Lobe::none || light.samples == 1 || !light.stratified) return direction;
  VF alpha2 = load(&hits.alpha2[slot]);
  if constexpr (kLobe == Lobe::layered) {
    const MF coated = hn::Gt(load(&hits.lobes->coat[slot]), hn::Zero(kF));
    alpha2 = hn::IfThenElse(coated, hn::Min(alpha2, load(&hits.lobes->coat_alpha2[slot])), alpha2);
  }
  const MF narrow = hn::Lt(alpha2, hn::Add(sample_turn2, sample_turn2));
  if (hn::AllFalse(kF, narrow)) return direction;
  return select(narrow, towards_stratum(light, s, hits, slot), direction);
}

// Adds one light sample, with the visibility found by tracing.
template <Lobe kLobe>
HWY_INLINE void add_sample(const TileJob& job, const LightRecord& light, int s, const HighlightUse& use,
                           HitBatch& hits, int slot) {
  const TileScratch& scratch = *job.scratch;
  const V3 to_light = way_to_light(light, s, hits, slot);
  const VF visible = load(&scratch.visible[slot]);
  const bool counts_twice = job.shading->plan->catchers && !light.is_virtual;
  MF counts = hn::Ne(visible, hn::Zero(kF));
  if (counts_twice) counts = hn::Or(counts, hn::Ne(load(&scratch.visible_without[slot]), hn::Zero(kF)));
  const MF lit = hn::And(facing(hits, slot, to_light), counts);
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
  const VF turn = hn::Mul(per_distance, set(light.half_turn_m)), turn2 = hn::Mul(turn, turn);
  const HighlightParts parts = highlight_parts<kLobe>(light, use, hits, slot, direction, turn2);
  const VF spread2 = hn::Max(parts.base.turn2, parts.coat.turn2);
  const V3 shines = shining_from<kLobe>(light, s, hits, slot, direction, spread2);
  V3 f = reflectance<kLobe>(hits, slot, n, shines, n_l, parts);
  if (job.shading->plan->catchers) {
    // On a catcher the sum is irradiance itself, twice: with all that is virtual, lights too, and without.
    const MF catcher = of_kind(hits, slot, HitKind::catcher);
    if (!hn::AllFalse(kF, catcher)) {
      const VF one = set(1.0f);
      f = select(catcher, V3{one, one, one}, f);
      if (!light.is_virtual) {
        const VF alone = hn::Mul(geometry, load(&scratch.visible_without[slot]));
        add_to(hits.direct_without, slot, scale(set3(light.intensity), alone));
      }
    }
  }
  const V3 arrives = scale(set3(light.intensity), seen);
  add_to(hits.direct, slot, {hn::Mul(arrives.x, f.x), hn::Mul(arrives.y, f.y), hn::Mul(arrives.z, f.z)});
}

// Queues one shadow ray for each hit that faces sample `s`, and assumes it visible.
HWY_NOINLINE inline void queue_shadow_rays(const TileJob& job, const LightRecord& light, int s,
                                           const HitBatch& hits, int count) {
  TileScratch& scratch = *job.scratch;
  begin_light_rays(scratch.queue, light, s);
  for (int slot = 0; slot < count; slot += kLanes) {
    const V3 to_light = way_to_light(light, s, hits, slot);
    hn::Store(set(1.0f), kF, &scratch.visible[slot]);
    hn::Store(set(1.0f), kF, &scratch.visible_without[slot]);
    push_shadow_rays(scratch.queue, hits, slot, to_light, facing(hits, slot, to_light));
  }
}

HWY_NOINLINE inline void find_visibility(const TileJob& job, const LightRecord& light, const HitBatch& hits,
                                         RayKind kind) {
  TileScratch& scratch = *job.scratch;
  trace_visibility(
      job, hits, !light.is_virtual, kind, RayKind::catcher_shadow,
      [&](std::size_t hit, float passes) { scratch.visible[hit] = passes; },
      [&](std::size_t hit, float passes) { scratch.visible_without[hit] = passes; });
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
