// A lamp's light by few points, each times what is seen of its samples; and which hits are shaded sample by
// sample instead. Before: shading_points, adaptive_light-inl.h says what is seen. After: direct light.
#pragma once

#include "renderer/direct_light/rotated_strata-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// A highlight's peak is F0 / (pi alpha^2) to a factor near 1. From this value of F0 / alpha^2 on - polished
// metal; glaze and porcelain have 10 ... 25 - it comes from few strata, each of which weighs so much that
// none is guessed.
constexpr float kGlossyPeak = 100.0f;

HWY_INLINE MF is_glossy(const HitBatch& hits, int slot) {
  const V3 f0 = load3(hits.f0, slot);
  return hn::Gt(hn::Max(f0.x, hn::Max(f0.y, f0.z)), hn::Mul(load(&hits.alpha2[slot]), set(kGlossyPeak)));
}

// Hits that are near the lamp, or of which some of it lies below the horizon and not all.
HWY_INLINE MF needs_places(const LightRecord& light, const ShadingPoints& points, const HitBatch& hits,
                           int slot) {
  const V3 way = sub(set3(light.centre), load3(hits.position, slot));
  const V3 half{set(0.5f * light.size[0]), set(0.5f * light.size[1]), set(0.5f * light.size[2])};
  const auto cut = [&](const V3& n) HWY_ATTR {
    const VF reach = dot(V3{hn::Abs(n.x), hn::Abs(n.y), hn::Abs(n.z)}, half);
    return hn::Le(hn::Abs(dot(n, way)), reach);
  };
  const auto beyond = [](VF across, VF half_edge)
                          HWY_ATTR { return hn::Max(hn::Sub(hn::Abs(across), half_edge), hn::Zero(kF)); };
  const V3 gap{beyond(way.x, half.x), beyond(way.y, half.y), beyond(way.z, half.z)};
  const MF near = hn::Lt(dot(gap, gap), set(points.nearest2));
  return hn::Or(near, hn::Or(cut(load3(hits.normal, slot)), cut(load3(hits.geometric_normal, slot))));
}

// Highlights that the points do not resolve, of a lamp that no direction can be drawn to (draws() knows of
// others): narrower than what half vectors turn from point to point.
HWY_INLINE MF narrower_than_points(const LightRecord& few, const HitBatch& hits, int slot, Highlight which) {
  const VF n_v = dot(lobe_normal(hits, slot, which), load3(hits.viewer, slot));
  const VF turn2 = turn2_across_stratum(few, half_vector(few, hits, slot));
  return hn::Lt(drawn_alpha2(hits, slot, which, n_v), hn::Mul(set(kResolvedAlpha2), turn2));
}
template <Lobe kLobe>
HWY_INLINE MF narrower_than_points(const LightRecord& few, const HitBatch& hits, int slot) {
  if constexpr (kLobe == Lobe::none) return first_lanes(0);
  MF narrow = narrower_than_points(few, hits, slot, Highlight::base);
  if constexpr (kLobe == Lobe::layered) {
    const MF coated = hn::Gt(load(&hits.lobes->coat[slot]), hn::Zero(kF));
    narrow = hn::Or(narrow, hn::And(coated, narrower_than_points(few, hits, slot, Highlight::coat)));
  }
  return narrow;
}

// Finds hits that are shaded sample by sample: those, and highlights that the points do not resolve.
// `use`: of the lamp itself; `of_points`: of its points.
template <Lobe kLobe>
HWY_NOINLINE void find_by_samples(const LightRecord& light, const ShadingPoints& points,
                                  const HighlightUse& use, const HighlightUse& of_points,
                                  const HitBatch& hits, int count, AdaptiveLight& adaptive) {
  for (int slot = 0; slot < count; slot += kLanes) {
    MF by_samples = hn::Or(is_glossy(hits, slot), needs_places(light, points, hits, slot));
    for (const HighlightUse* one : {&use, &of_points}) {
      if (one->shares_base) by_samples = hn::Or(by_samples, used_as(one->base, slot, kShared));
      if (one->shares_coat) by_samples = hn::Or(by_samples, used_as(one->coat, slot, kShared));
    }
    if (!meets_directions(points.light))
      by_samples = hn::Or(by_samples, narrower_than_points<kLobe>(points.light, hits, slot));
    hn::Store(hn::IfThenElseZero(by_samples, set(1.0f)), kF, &adaptive.by_samples[slot]);
  }
}

// What is seen of a lamp, as it changes evenly across it: the mean, and the slope along each axis over the
// root mean square of the lamp's places. Light that itself changes evenly is so right in the mean.
struct VisibleFit {
  VF mean;
  std::array<VF, 3> slope;

  // Of `rays` to places that add up to `all_places`, of which those blocked number and add up to so much.
  HWY_INLINE VisibleFit(VF rays, const std::array<VF, 3>& all_places, VF blocked,
                        const std::array<VF, 3>& blocked_places) {
    const VF per_ray = hn::Div(set(1.0f), rays), share = hn::Mul(blocked, per_ray);
    mean = hn::Sub(set(1.0f), share);
    for (std::size_t axis = 0; axis < 3; ++axis)
      slope[axis] = hn::Mul(per_ray, hn::Sub(hn::Mul(share, all_places[axis]), blocked_places[axis]));
  }
  HWY_INLINE VF at(const ShadingPoints& points, int point) const {
    VF seen = mean;
    for (std::size_t axis = 0; axis < 3; ++axis)
      seen = hn::MulAdd(slope[axis], set(points.point_at[axis][static_cast<std::size_t>(point)]), seen);
    return seen;
  }
};

// Sample `s` of hits that are shaded by samples: traced where they ask, elsewhere as decided.
template <Lobe kLobe>
HWY_NOINLINE void shade_sample(const TileJob& job, const LightRecord& light, int s, const HighlightUse& use,
                               HitBatch& hits, RayKind kind) {
  TileScratch& scratch = *job.scratch;
  const AdaptiveLight& adaptive = *scratch.adaptive;
  const VF zero = hn::Zero(kF), one = set(1.0f);
  begin_light_rays(scratch.queue, light, s);
  for (const int slot : adaptive.open()) {
    const MF lanes = hn::Gt(load(&adaptive.by_samples[slot]), zero),
             asks = hn::And(lanes, hn::Gt(load(&adaptive.asks[slot]), zero));
    const auto known = [&](const Lane<float>& seen) HWY_ATTR {
      return hn::IfThenElseZero(hn::And(lanes, hn::Or(asks, hn::Gt(load(&seen[slot]), zero))), one);
    };
    hn::Store(known(adaptive.seen), kF, &scratch.visible[slot]);
    hn::Store(known(adaptive.seen_without), kF, &scratch.visible_without[slot]);
    if (hn::AllFalse(kF, asks)) continue;
    const V3 to_light = way_to_light(light, s, hits, slot);
    push_shadow_rays(scratch.queue, hits, slot, to_light, hn::And(asks, facing(hits, slot, to_light)));
  }
  find_visibility(job, light, hits, kind);
  for (const int slot : adaptive.open()) add_sample<kLobe>(job, light, s, use, hits, slot);
}

// Light so far, where a lamp's own fell below 0. What is not a number stays so: the second operand is taken
// then.
HWY_INLINE void keep_at_least(const V3& before, Lane3& light, int slot) {
  const V3 sum = load3(light, slot);
  store3({hn::Max(before.x, sum.x), hn::Max(before.y, sum.y), hn::Max(before.z, sum.z)}, light, slot);
}

// Of all other hits, the light of the points, each times what is seen of the lamp there; of hits that
// decided, all or nothing. `rays` and `sums`: of hits that asked. What is seen at a point may be below 0, the
// light of all is not.
template <Lobe kLobe>
HWY_NOINLINE void shade_points(const TileJob& job, const ShadingPoints& points, const HighlightUse& use,
                               int rays, const PlaceSums& sums, HitBatch& hits, int count) {
  TileScratch& scratch = *job.scratch;
  const AdaptiveLight& adaptive = *scratch.adaptive;
  const VF zero = hn::Zero(kF), one = set(1.0f);
  for (int slot = 0; slot < count; slot += kLanes) {
    const MF lanes = hn::Eq(load(&adaptive.by_samples[slot]), zero);
    if (hn::AllFalse(kF, lanes)) continue;
    const MF mixed = hn::Gt(load(&adaptive.mixed[slot]), zero);
    std::array<VF, 3> all_places;
    for (std::size_t axis = 0; axis < 3; ++axis)
      all_places[axis] = hn::GatherIndex(kF, sums.of_axis[axis].data(), start_of(adaptive, slot));
    const auto fit_of = [&](const Lane<float>& first, const BlockedSums<Lane<float>>& blocked) HWY_ATTR {
      const MF smoothed = hn::Gt(load(&adaptive.smoothed[slot]), zero);
      const std::array<VF, 3> places{load(&blocked.places[0][slot]), load(&blocked.places[1][slot]),
                                     load(&blocked.places[2][slot])};
      const VF blocked_count = load(&blocked.count[slot]);
      VisibleFit fit(set(static_cast<float>(rays)), all_places, blocked_count, places);
      const VF decided = hn::IfThenElseZero(hn::Gt(load(&first[slot]), zero), one);
      fit.mean = hn::IfThenElse(mixed, hn::IfThenElse(smoothed, blocked_count, fit.mean), decided);
      for (std::size_t axis = 0; axis < 3; ++axis)
        fit.slope[axis] = hn::IfThenElseZero(mixed, hn::IfThenElse(smoothed, places[axis], fit.slope[axis]));
      return fit;
    };
    const VisibleFit with = fit_of(adaptive.seen, adaptive.blocked),
                     without = fit_of(adaptive.seen_without, adaptive.blocked_without);
    const V3 before = load3(hits.direct, slot), before_without = load3(hits.direct_without, slot);
    for (int point = 0; point < points.light.samples; ++point) {
      hn::Store(hn::IfThenElseZero(lanes, with.at(points, point)), kF, &scratch.visible[slot]);
      hn::Store(hn::IfThenElseZero(lanes, without.at(points, point)), kF, &scratch.visible_without[slot]);
      add_sample<kLobe>(job, points.light, point, use, hits, slot);
    }
    keep_at_least(before, hits.direct, slot);
    if (job.shading->plan->catchers) keep_at_least(before_without, hits.direct_without, slot);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
