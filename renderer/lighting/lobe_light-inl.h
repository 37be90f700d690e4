// A light as directions drawn from a highlight meet it: which highlights are drawn from, the chord that a
// direction cuts through the light's box, and how strata and drawn directions share a highlight between them
// (balance heuristic: Veach & Guibas, "Optimally Combining Sampling Techniques", 1995).
// The light shines uniformly from its box, I / V from each part of the volume V: along a direction its
// radiance is I / V times the integral of t^2 / max(t^2, r^2) over the chord (falloff).
// Before: lobe_directions. After: light_samples weighs strata, lobe_samples draws.
#pragma once

#include <algorithm>
#include <cmath>

#include "renderer/lighting/lobe_directions-inl.h"

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

// Shadow rays of a drawn highlight, and how many directions are drawn to choose each from: one ray for eight
// samples of the light.
struct LobeCounts {
  int rays, each;
  int all() const { return rays * each; }
};
HWY_INLINE LobeCounts lobe_counts(const LightRecord& light) {
  constexpr int kSamplesPerRay = 8, kFewestDirections = 32, kFewestEach = 4;
  const int rays = std::max(1, light.samples / kSamplesPerRay);
  return {rays, std::max(kFewestEach, (kFewestDirections + rays - 1) / rays)};
}

// Whether directions can meet the light: rods and points have no extent to meet. One sample is the highlight
// of the middle, as wide as the light.
constexpr float kThinnestRod = 0.01f;
HWY_INLINE bool meets_directions(const LightRecord& light) {
  const float x = light.size[0], y = light.size[1], z = light.size[2];
  const float longest = std::max({x, y, z});
  const float middle = std::max(std::min(x, y), std::min(std::max(x, y), z));
  return light.samples > 1 && middle > kThinnestRod * longest;
}

// The light's box. Plates are a thousandth of their longest edge thick.
struct LightBox {
  float centre[3], half[3];
  float volume;
};
HWY_INLINE LightBox box_of(const LightRecord& light) {
  constexpr float kPlate = 1e-3f;
  const float longest = std::max({light.size[0], light.size[1], light.size[2]});
  LightBox box;
  box.volume = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const float size = std::max(light.size[axis], kPlate * longest);
    box.centre[axis] = light.centre[axis];
    box.half[axis] = 0.5f * size;
    box.volume *= size;
  }
  return box;
}

// What a ray from `p` along `direction` (unit) has of the box; no length, or less, where it misses.
struct Chord {
  VF begin, length;
};
HWY_INLINE Chord chord_through(const LightBox& box, const V3& p, const V3& direction) {
  VF middle[3], half[3];
  const VF from[3] = {p.x, p.y, p.z}, along[3] = {direction.x, direction.y, direction.z};
  for (int axis = 0; axis < 3; ++axis) {
    const VF per_length =
        hn::Div(set(1.0f), hn::CopySign(hn::Max(hn::Abs(along[axis]), set(1e-9f)), along[axis]));
    middle[axis] = hn::Mul(hn::Sub(set(box.centre[axis]), from[axis]), per_length);
    half[axis] = hn::Mul(set(box.half[axis]), hn::Abs(per_length));
  }
  const auto least = [](VF a, VF b, VF c) HWY_ATTR { return hn::Min(a, hn::Min(b, c)); };
  const VF zero = hn::Zero(kF);
  const VF begin = hn::Neg(least(zero, hn::Sub(half[0], middle[0]),
                                 hn::Min(hn::Sub(half[1], middle[1]), hn::Sub(half[2], middle[2]))));
  const VF end = least(hn::Add(half[0], middle[0]), hn::Add(half[1], middle[1]), hn::Add(half[2], middle[2]));
  // The length by each two faces, not as a difference of distances: a plate's is not lost in rounding.
  const auto between = [&](int a, int b) HWY_ATTR {
    return hn::Sub(hn::Add(half[a], half[b]), hn::Abs(hn::Sub(middle[a], middle[b])));
  };
  const VF through = least(hn::Add(half[0], half[0]), hn::Add(half[1], half[1]), hn::Add(half[2], half[2]));
  const VF across = least(between(0, 1), between(0, 2), between(1, 2));
  return {begin, least(through, across, end)};
}

// How densely a light's samples lie along a direction, per steradian: N / V times the integral of t^2.
HWY_INLINE VF density_of_strata(const LightRecord& light, const LightBox& box, const Chord& chord) {
  const VF length = hn::Max(chord.length, hn::Zero(kF));
  const VF square = hn::MulAdd(chord.begin, hn::Add(chord.begin, length),
                               hn::Mul(set(1.0f / 3.0f), hn::Mul(length, length)));
  return hn::Mul(hn::Mul(set(static_cast<float>(light.samples) / box.volume), length), square);
}

// Highlights with less than this of (alpha / what half vectors turn by across a stratum)^2 are drawn from.
constexpr float kResolvedAlpha2 = 8.0f;

// Hits whose highlight of a light is drawn from: narrower than its strata resolve, and near enough to the
// light. Beyond, strata see its tail alone, which falls with the fourth power of the distance: half of it
// over as many strata, at least, as lie between.
template <Lobe kLobe>
HWY_INLINE MF draws(const LightRecord& light, const HitBatch& hits, int slot, Highlight which, VF n_v) {
  constexpr float kTail = 8.0f;
  const V3 n = lobe_normal(hits, slot, which), v = load3(hits.viewer, slot);
  const V3 way = sub(set3(light.centre), load3(hits.position, slot));
  const VF distance2 = hn::Max(dot(way, way), set(std::max(light.min_distance2, 1e-30f)));
  const V3 h = normalise(add(normalise(way), v));
  // Half vectors turn by half of what the light's places turn, and by more off the plane of incidence.
  const VF l_h = hn::Max(dot(v, h), set(0.05f));
  const VF per_metre = hn::Div(set(1.0f), hn::Mul(hn::Sqrt(distance2), l_h));
  const VF step = hn::Mul(per_metre, set(light.half_turn_m)), step2 = hn::Mul(step, step);
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
  const VF reach = hn::MulAdd(per_metre, set(0.5f * radius), hn::Mul(set(kTail), hn::Sqrt(wide2)));
  const V3 off = cross(n, h);
  return hn::And(lanes, hn::Lt(dot(off, off), hn::Mul(reach, reach)));
}

// What a sample of the light in `direction` brings of one highlight; across its stratum half vectors turn by
// the root of turn2.
template <Lobe kLobe>
HWY_INLINE HighlightPart highlight_part(const LightRecord& light, const HitBatch& hits, int slot,
                                        const V3& direction, VF turn2, Highlight which) {
  const V3 v = load3(hits.viewer, slot);
  const VF n_v = dot(lobe_normal(hits, slot, which), v), one = set(1.0f);
  const HighlightPart whole{hn::IfThenZeroElse(hn::Gt(n_v, set(kLeastViewerCosine)), turn2), one};
  const MF drawn = draws<kLobe>(light, hits, slot, which, n_v);
  if (hn::AllFalse(kF, drawn)) return whole;
  const LightBox box = box_of(light);
  const Chord chord = chord_through(box, load3(hits.position, slot), direction);
  const DrawnLobe lobe = drawn_lobe<kLobe>(hits, slot, which);
  const VF by_strata = density_of_strata(light, box, chord);
  const VF by_lobe = hn::Mul(set(static_cast<float>(lobe_counts(light).all())),
                             density_of(lobe, normalise(add(direction, v))));
  const VF share = hn::Div(by_strata, hn::Max(hn::Add(by_strata, by_lobe), set(1e-30f)));
  return {whole.turn2, hn::IfThenElse(drawn, share, one)};
}

template <Lobe kLobe>
HWY_INLINE HighlightParts highlight_parts(const LightRecord& light, const HitBatch& hits, int slot,
                                          const V3& direction, VF turn2) {
  HighlightParts parts = whole_highlights(turn2);
  if (kLobe == Lobe::none || !meets_directions(light)) return parts;
  parts.base = highlight_part<kLobe>(light, hits, slot, direction, turn2, Highlight::base);
  if constexpr (kLobe == Lobe::layered) {
    parts.coat = highlight_part<kLobe>(light, hits, slot, direction, turn2, Highlight::coat);
  } else {
    parts.coat.turn2 = hn::Zero(kF);
  }
  return parts;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
