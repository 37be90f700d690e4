// The environment picture as a lobe shows it, but for bright sources: in a few directions, each as wide as
// the lobe is across, or, where that is less than a texel, in directions all over the lobe's core. Before:
// environment/ made the levels. After: gloss-inl.h. Sources: directions within the lobe by Heitz (2018) and
// Dupuy & Benyoub (2023).
#pragma once

#include "renderer/environment/filtered_lookup-inl.h"
#include "renderer/highlights/highlight_width-inl.h"
#include "renderer/highlights/visible_normals-inl.h"
#include "renderer/reflectance/interfaces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

struct LobeSeen {
  V3 n, v;  // unit
  VF n_v;   // above 0
  V3 f0;
  VF f90;
};

// Squares of alpha, as half vectors turn.
struct LobeWidths {
  VF seen2;     // the lobe's own, with what spreads it over a curved surface; no level is narrower
  VF smooth2;   // at least that; as wide as a texel is across the plane in which the lobe is longest
  VF filtered;  // the rest of [0, 1] is the picture's own, in the mirrored direction
};
HWY_INLINE LobeWidths widths_of(const FilteredRecord& from, const HitBatch& hits, int slot,
                                const LobeSeen& lobe) {
  const VF turn2 = hn::Mul(set(0.25f), turn2_between_rays(hits, slot, lobe.n_v));
  const VF own2 = hn::Add(load(&hits.alpha2[slot]), turn2);
  const VF seen2 = hn::Max(own2, set(from.first_alpha * from.first_alpha));
  const VF texel2 = hn::Div(set(from.smooth_alpha * from.smooth_alpha), hn::Mul(lobe.n_v, lobe.n_v));
  return {seen2, hn::Max(seen2, hn::Min(texel2, set(1.0f))), filtered_share(from, own2)};
}

HWY_INLINE DrawnLobe drawn_from(const HitBatch& hits, int slot, const LobeSeen& lobe) {
  DrawnLobe out;
  out.t = across_towards(lobe.n, lobe.v, lobe.n_v);
  out.alpha_t = out.alpha_b = hn::Sqrt(load(&hits.alpha2[slot]));
  set_up(out, lobe.n, lobe.v, lobe.n_v);
  return out;
}

// Directions along the plane of normal and viewer: how far their slope is off the normal's, in alpha. GGX has
// Student's distribution of two degrees of freedom along an axis; these stand for its middle two thirds and
// for the rest, nearer by as much as each is wide itself: chosen by charts of balls in four pictures.
struct LobeDirection {
  float slope, weight;
};
constexpr LobeDirection kLobeDirections[] = {{0.354f, 1.0f}, {-0.354f, 1.0f}, {1.3f, 0.4f}, {-1.3f, 0.4f}};

// Mean radiance over the lobe, per channel.
HWY_INLINE V3 light_in_lobe(const FilteredRecord& from, float turn, const HitBatch& hits, int slot,
                            const LobeSeen& lobe) {
  const VF zero = hn::Zero(kF), one = set(1.0f), alpha2 = load(&hits.alpha2[slot]);
  const DrawnLobe drawn = drawn_from(hits, slot, lobe);
  // Head on the lobe is round, and one direction would do.
  const VF longer2 = hn::Max(hn::NegMulAdd(lobe.n_v, lobe.n_v, one), set(1e-6f));
  const V3 f90{lobe.f90, lobe.f90, lobe.f90};
  V3 sum{zero, zero, zero}, weights = sum;
  for (const LobeDirection& of : kLobeDirections) {
    const VF slope2 = hn::Mul(set(of.slope * of.slope), longer2);
    const VF side = set(of.slope > 0 ? 1.0f : -1.0f);
    const DrawnDirection at = draw(drawn, lobe.v, side, zero, hn::Div(slope2, hn::Add(one, slope2)));
    const VF l_h = hn::Max(dot(at.direction, at.h), set(0.1f)), n_l = dot(lobe.n, at.direction);
    const VF turn2 = hn::Mul(set(0.25f), turn2_between_rays(hits, slot, l_h));
    const VF width2 = hn::MulAdd(hn::Mul(alpha2, l_h), l_h, turn2);
    const VF alpha = hn::Min(hn::Max(hn::Sqrt(width2), set(from.smooth_alpha)), one);
    const VF below =
        hn::Sqrt(hn::MulAdd(hn::NegMulAdd(alpha2, hn::Mul(n_l, n_l), hn::Mul(n_l, n_l)), one, alpha2));
    const VF open = hn::Max(hn::Div(hn::Add(n_l, n_l), hn::Max(hn::Add(n_l, below), set(1e-6f))), set(1e-3f));
    const V3 light = filtered_light(from, turn, at.direction, alpha);
    const VF share = hn::Mul(open, set(of.weight));
    const V3 weight = scale(mul_add(schlick_weight(l_h), sub(f90, lobe.f0), lobe.f0), share);
    sum = mul_add(weight, light, sum);
    weights = add(weights, weight);
  }
  const auto mean = [](VF total, VF weight) HWY_ATTR { return hn::Div(total, hn::Max(weight, set(1e-20f))); };
  return {mean(sum.x, weights.x), mean(sum.y, weights.y), mean(sum.z, weights.z)};
}

constexpr int kCoreRings = 6, kPlacesOfRing = 4;

// Half vectors of the lobe lie within r of the normal with a share of r^2 / (r^2 + alpha^2). A wider one of
// alpha^2 k has the same tails where it counts 1 / k; what it lacks is the core, and a share q of that lies
// within s = (r / alpha)^2 where s / (1 + s) - s / k (k + s) = q (1 - 1 / k): a square equation in s.
HWY_INLINE VF core_within(float q, VF k) {
  const VF one = set(1.0f), part = hn::Mul(set(q), hn::Sub(k, one));
  const VF a = hn::Sub(hn::Sub(k, one), part);
  const VF b = hn::NegMulAdd(part, hn::Add(one, k), hn::MulSub(k, k, one)), c = hn::Mul(part, k);
  const VF root = hn::Sqrt(hn::MulAdd(b, b, hn::Mul(hn::Mul(set(4.0f), a), c)));
  return hn::Div(hn::Add(c, c), hn::Max(hn::Add(b, root), set(1e-20f)));
}

// Mean radiance over what the lobe has beyond one of `smooth2`, of the picture without small sources.
HWY_NOINLINE inline V3 core_of_lobe(const FilteredRecord& from, const HitBatch& hits, int slot,
                                    const LobeSeen& lobe, const LobeWidths& widths) {
  // Eighths of a turn, every other one on every other ring.
  constexpr float kDiagonal = 0.707106781f;
  constexpr float kCosines[2][kPlacesOfRing] = {{1, 0, -1, 0},
                                                {kDiagonal, -kDiagonal, -kDiagonal, kDiagonal}};
  constexpr float kSines[2][kPlacesOfRing] = {{0, 1, 0, -1}, {kDiagonal, kDiagonal, -kDiagonal, -kDiagonal}};
  const VF one = set(1.0f), wider = hn::Max(hn::Div(widths.smooth2, widths.seen2), set(1.01f));
  const DrawnLobe drawn = drawn_from(hits, slot, lobe);
  V3 sum{hn::Zero(kF), hn::Zero(kF), hn::Zero(kF)};
  for (int ring = 0; ring < kCoreRings; ++ring) {
    const VF s = core_within((static_cast<float>(ring) + 0.5f) / kCoreRings, wider);
    const VF u = hn::Div(s, hn::Add(one, s));
    for (int i = 0; i < kPlacesOfRing; ++i) {
      const VF cosine = set(kCosines[ring % 2][i]), sine = set(kSines[ring % 2][i]);
      const DrawnDirection at = draw(drawn, lobe.v, cosine, sine, u);
      sum = add(sum, environment_texel(from.without_small, at.direction));
    }
  }
  return scale(sum, set(1.0f / (kCoreRings * kPlacesOfRing)));
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
