// A lamp's light by few points, each times what is seen of its samples; and which hits are shaded sample by
// sample instead. Before: shading_points, adaptive_light-inl.h says what is seen. After: direct light.
#pragma once

#include "renderer/direct_light/light_samples-inl.h"

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

// Of hits that are shaded sample by sample, the light of sample `s`.
template <Lobe kLobe>
HWY_NOINLINE void shade_sample(const TileJob& job, const LightRecord& light, int s, const HighlightUse& use,
                               HitBatch& hits) {
  TileScratch& scratch = *job.scratch;
  for (const int slot : scratch.adaptive->open()) {
    const MF lanes = hn::Gt(load(&scratch.adaptive->by_samples[slot]), hn::Zero(kF));
    if (hn::AllFalse(kF, lanes)) continue;
    for (Lane<float>* share : {&scratch.visible, &scratch.visible_without})
      hn::Store(hn::IfThenElseZero(lanes, load(&(*share)[slot])), kF, &(*share)[slot]);
    add_sample<kLobe>(job, light, s, use, hits, slot);
  }
}

// Of all other hits, the light of the points, each times what is seen of its samples.
template <Lobe kLobe>
HWY_NOINLINE void shade_points(const TileJob& job, const ShadingPoints& points, const HighlightUse& use,
                               HitBatch& hits, int count) {
  TileScratch& scratch = *job.scratch;
  const AdaptiveLight& adaptive = *scratch.adaptive;
  const VF per_sample = set(1.0f / points.samples_each), zero = hn::Zero(kF);
  for (int slot = 0; slot < count; slot += kLanes) {
    const MF lanes = hn::Eq(load(&adaptive.by_samples[slot]), zero);
    if (hn::AllFalse(kF, lanes)) continue;
    const MF undecided = hn::Gt(load(&adaptive.undecided[slot]), zero);
    const auto share_of = [&](const Lane<float>& first, const Lane<float>& seen) HWY_ATTR {
      const VF decided = hn::IfThenElseZero(hn::Gt(load(&first[slot]), zero), set(1.0f));
      return hn::IfThenElseZero(lanes,
                                hn::IfThenElse(undecided, hn::Mul(load(&seen[slot]), per_sample), decided));
    };
    for (int point = 0; point < points.light.samples; ++point) {
      const auto i = static_cast<std::size_t>(point);
      hn::Store(share_of(adaptive.seen, adaptive.of_point[i]), kF, &scratch.visible[slot]);
      hn::Store(share_of(adaptive.seen_without, adaptive.of_point_without[i]), kF,
                &scratch.visible_without[slot]);
      add_sample<kLobe>(job, points.light, point, use, hits, slot);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
