// Which highlights of a lamp directions are drawn from, how many, and how strata and drawn directions share a
// highlight between them (balance heuristic: Veach & Guibas, "Optimally Combining Sampling Techniques",
// 1995). Lobes are as wide as their rays ask for. Before: reflectance. After: light_samples weighs strata,
// lobe_samples draws.
#pragma once

#include <algorithm>
#include <cmath>

#include "renderer/highlights/light_box-inl.h"
#include "renderer/highlights/visible_normals-inl.h"
#include "renderer/reflectance/reflectance-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Which highlight of a hit: the surface's own, or its coat's.
enum class Highlight : std::uint8_t { base, coat };

// Below this cosine to the viewer, highlights are not drawn from.
constexpr float kLeastViewerCosine = 1e-3f;

HWY_INLINE V3 lobe_normal(const HitBatch& hits, int slot, Highlight which) {
  return load3(which == Highlight::coat ? hits.lobes->coat_normal : hits.normal, slot);
}

// alpha^2 of a highlight in its middle, as wide as its ray asks for. Of a stretched one, across its length.
HWY_INLINE VF drawn_alpha2(const HitBatch& hits, int slot, Highlight which, VF n_v) {
  const VF alpha2 = load(which == Highlight::coat ? &hits.lobes->coat_alpha2[slot] : &hits.alpha2[slot]);
  return widened(hits, slot, alpha2, n_v, hn::Zero(kF));
}

template <Lobe kLobe>
HWY_INLINE DrawnLobe drawn_lobe(const HitBatch& hits, int slot, Highlight which) {
  DrawnLobe lobe;
  const V3 n = lobe_normal(hits, slot, which);
  const V3 v = load3(hits.viewer, slot);
  const VF n_v = dot(n, v);
  lobe.t = across_towards(n, v, n_v);
  lobe.alpha_b = lobe.alpha_t = hn::Sqrt(drawn_alpha2(hits, slot, which, n_v));
  if constexpr (kLobe == Lobe::layered) {
    if (which == Highlight::base) {
      const VF strength = load(&hits.lobes->stretch[slot]);
      const MF stretched = hn::Gt(strength, hn::Zero(kF));
      lobe.t = select(stretched, load3(hits.lobes->tangent, slot), lobe.t);
      lobe.alpha_t = hn::IfThenElse(stretched, alpha_along(lobe.alpha_b, strength), lobe.alpha_t);
    }
  }
  set_up(lobe, n, v, n_v);
  return lobe;
}

// How densely directions of half vector `h` are drawn from a highlight (density_of). One that is not
// stretched needs no frame.
template <Lobe kLobe>
HWY_INLINE VF drawn_density(const HitBatch& hits, int slot, Highlight which, const V3& h) {
  if constexpr (kLobe == Lobe::layered) {
    const MF stretched = hn::Gt(load(&hits.lobes->stretch[slot]), hn::Zero(kF));
    if (which == Highlight::base && !hn::AllFalse(kF, stretched)) {
      return density_of(drawn_lobe<kLobe>(hits, slot, which), h);
    }
  }
  const V3 n = lobe_normal(hits, slot, which);
  const VF n_v = dot(n, load3(hits.viewer, slot));
  return density_of(drawn_alpha2(hits, slot, which, n_v), n, n_v, h);
}

// Shadow rays of a drawn highlight, and how many directions are drawn to choose each from: one ray for eight
// samples of the light.
struct LobeCounts {
  int rays, each;
  int all() const { return rays * each; }
};
HWY_INLINE LobeCounts lobe_counts(const LightRecord& light) {
  constexpr int kSamplesPerRay = 8, kFewestDirections = 16, kFewestEach = 4;
  const int rays = std::max(1, light.samples / kSamplesPerRay);
  return {rays, std::max(kFewestEach, (kFewestDirections + rays - 1) / rays)};
}

// Highlights with less than this of (alpha / what half vectors turn by across a stratum)^2 are drawn from.
constexpr float kResolvedAlpha2 = 8.0f;

// The half vector of the light's middle, and what half vectors turn by for each metre across the light: half
// of what its places turn, and more off the plane of incidence.
struct HalfVector {
  V3 h;
  VF per_metre;
};
HWY_INLINE HalfVector half_vector(const LightRecord& light, const HitBatch& hits, int slot) {
  const V3 v = load3(hits.viewer, slot);
  const V3 way = sub(set3(light.centre), load3(hits.position, slot));
  const VF distance2 = hn::Max(dot(way, way), set(std::max(light.min_distance2, 1e-30f)));
  const V3 h = normalise(add(normalise(way), v));
  const VF l_h = hn::Max(dot(v, h), set(0.05f));
  return {h, hn::Div(set(1.0f), hn::Mul(hn::Sqrt(distance2), l_h))};
}
HWY_INLINE VF turn2_across_stratum(const LightRecord& light, const HalfVector& half) {
  const VF turn = hn::Mul(half.per_metre, set(light.half_turn_m));
  return hn::Mul(turn, turn);
}

// Hits whose highlight of a light is drawn from: narrower than its strata resolve, and its middle so near to
// the light that these see more than its tail, which changes little from one to the next.
template <Lobe kLobe>
HWY_INLINE MF draws(const LightRecord& light, const HitBatch& hits, int slot, Highlight which, VF n_v) {
  constexpr float kTail = 4.0f;
  const V3 n = lobe_normal(hits, slot, which);
  const HalfVector half = half_vector(light, hits, slot);
  const VF step2 = turn2_across_stratum(light, half);
  const VF alpha2 = drawn_alpha2(hits, slot, which, n_v);
  MF lanes = hn::And(hn::Gt(n_v, set(kLeastViewerCosine)),
                     hn::RebindMask(kF, hn::Eq(hn::Load(kI, &hits.kind[slot]),
                                               hn::Set(kI, static_cast<int>(HitKind::object)))));
  lanes = hn::And(lanes, hn::Lt(alpha2, hn::Mul(set(kResolvedAlpha2), step2)));
  VF wide2 = hn::Max(alpha2, step2);
  if constexpr (kLobe == Lobe::layered) {
    const bool coat = which == Highlight::coat;
    const MF there = hn::Gt(load(coat ? &hits.lobes->coat[slot] : &hits.lobes->stretch[slot]), hn::Zero(kF));
    if (coat) {
      lanes = hn::And(lanes, there);
    } else {
      wide2 = hn::IfThenElse(there, set(1.0f), wide2);
    }
  }
  const float radius = 0.5f * std::sqrt(light.size[0] * light.size[0] + light.size[1] * light.size[1] +
                                        light.size[2] * light.size[2]);
  const VF reach = hn::MulAdd(half.per_metre, set(0.5f * radius), hn::Mul(set(kTail), hn::Sqrt(wide2)));
  const V3 off = cross(n, half.h);
  return hn::And(lanes, hn::Lt(dot(off, off), hn::Mul(reach, reach)));
}

// How the strata of one light bring the highlights of each hit: across the whole stratum, since no direction
// can be drawn; as they are; or sharing them with drawn directions.
enum : std::int32_t { kSpread = 0, kAlone = 1, kShared = 2 };
struct alignas(64) HighlightUse {
  Lane<std::int32_t> base, coat;
  bool shares_base = false, shares_coat = false;  // some hit does
};

template <Lobe kLobe>
HWY_NOINLINE bool find_use(const LightRecord& light, const HitBatch& hits, int count, Highlight which,
                           Lane<std::int32_t>& use) {
  bool any = false;
  for (int slot = 0; slot < count; slot += kLanes) {
    const VF n_v = dot(lobe_normal(hits, slot, which), load3(hits.viewer, slot));
    const MF drawn = draws<kLobe>(light, hits, slot, which, n_v);
    any = any || !hn::AllFalse(kF, drawn);
    const MF seen = hn::Gt(n_v, set(kLeastViewerCosine));
    const VI alone = hn::IfThenElseZero(hn::RebindMask(kI, seen), hn::Set(kI, kAlone));
    hn::Store(hn::IfThenElse(hn::RebindMask(kI, drawn), hn::Set(kI, kShared), alone), kI, &use[slot]);
  }
  return any;
}

// Fills `use` for hits [0, count) where directions can meet the light.
template <Lobe kLobe>
HWY_INLINE void find_use(const LightRecord& light, const HitBatch& hits, int count, HighlightUse& use) {
  if (kLobe == Lobe::none || !meets_directions(light)) return;
  use.shares_base = find_use<kLobe>(light, hits, count, Highlight::base, use.base);
  if constexpr (kLobe == Lobe::layered) {
    use.shares_coat = find_use<kLobe>(light, hits, count, Highlight::coat, use.coat);
  }
}

HWY_INLINE MF used_as(const Lane<std::int32_t>& use, int slot, std::int32_t as) {
  return hn::RebindMask(kF, hn::Eq(hn::Load(kI, &use[slot]), hn::Set(kI, as)));
}

// What a sample of the light in `direction` brings of one highlight; across its stratum half vectors turn by
// the root of turn2.
template <Lobe kLobe>
HWY_INLINE HighlightPart highlight_part(const LightRecord& light, const Lane<std::int32_t>& use,
                                        const HitBatch& hits, int slot, const V3& direction, VF turn2,
                                        Highlight which) {
  const VF one = set(1.0f);
  const HighlightPart whole{hn::IfThenElseZero(used_as(use, slot, kSpread), turn2), one};
  const MF shared = used_as(use, slot, kShared);
  if (hn::AllFalse(kF, shared)) return whole;
  const Chord chord = chord_through(box_of(light), load3(hits.position, slot), direction);
  const V3 h = normalise(add(direction, load3(hits.viewer, slot)));
  const VF by_strata = density_of_strata(light, box_of(light), chord);
  const VF by_lobe =
      hn::Mul(set(static_cast<float>(lobe_counts(light).all())), drawn_density<kLobe>(hits, slot, which, h));
  const VF share = hn::Div(by_strata, hn::Max(hn::Add(by_strata, by_lobe), set(1e-30f)));
  return {whole.turn2, hn::IfThenElse(shared, share, one)};
}

template <Lobe kLobe>
HWY_INLINE HighlightParts highlight_parts(const LightRecord& light, const HighlightUse& use,
                                          const HitBatch& hits, int slot, const V3& direction, VF turn2) {
  HighlightParts parts = whole_highlights(turn2);
  if (kLobe == Lobe::none || !meets_directions(light)) return parts;
  parts.base = highlight_part<kLobe>(light, use.base, hits, slot, direction, turn2, Highlight::base);
  parts.coat.turn2 = hn::Zero(kF);
  if constexpr (kLobe == Lobe::layered) {
    parts.coat = highlight_part<kLobe>(light, use.coat, hits, slot, direction, turn2, Highlight::coat);
  }
  return parts;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
