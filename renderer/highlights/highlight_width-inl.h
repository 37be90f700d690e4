// How wide a highlight is at least: as wide as what one ray, and one sample of a light, stand for. A narrower
// one would fall between rays. Before: surfaces, ray cones. After: reflectance, with a wider lobe of the same
// energy: light is spread, not lost.
// Source: Kaplanyan et al., "Filtering Distributions of Normals for Shading Antialiasing" (2016).
#pragma once

#include "renderer/simd/simd_types-inl.h"
#include "renderer/tiles/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// (alpha / s)^2 that a highlight has at least where the half vector turns by s from one ray to the next.
// Summed over rays, GGX ripples along each axis by 2 x K1(x) at most, x = 2 pi alpha / s (its Fourier
// transform at the lattice's period): not at all here. Pixels between polar samples see the beats of both
// lattices: the nearer their spacing, the longer these are and the less of them interpolation leaves. The
// worst are five pixels long, where samples lie 5 / 6 pixel apart and 2 sinc^2(5 / 6) = 0.08 is left: times
// x K1(x), x = 2 pi alpha / 5 s, 1.1 %.
constexpr float kLeastAlpha2OfStep2 = 5.0f;

// Square of what the half vector turns, against the normal, from one ray to the next. Over a ray's width w on
// a surface of curvature k the normal turns by w k, the direction to the viewer by the ray's spread and the
// half vector by half of that; by 1 / cos of it where the surface slopes, cos = n.v, which is l.h in the
// middle of the highlight. At a silhouette the normal turns by acos(1 - w k), by sqrt(2 w k) at most.
HWY_INLINE VF turn2_between_rays(const HitBatch& hits, int slot, VF l_h) {
  const VF half = set(0.5f);
  const VF turn = hn::MulAdd(load(&hits.cone_width[slot]), load(&hits.curvature[slot]),
                             hn::Mul(half, load(&hits.cone_spread[slot])));
  const VF cosine2 = hn::Max(hn::Max(hn::Mul(l_h, l_h), hn::Mul(half, turn)), set(1e-12f));
  return hn::Div(hn::Mul(turn, turn), cosine2);
}

// alpha^2 where widths (squared) must not be missed: alpha^2 / 2 + width^2, from the width itself at alpha =
// 0 on; lobes wider than sqrt(2) of it stay as they are. `sample_turn2`: square of what the half vector turns
// by across the part of the light that one sample stands for.
HWY_INLINE VF widened(const HitBatch& hits, int slot, VF alpha2, VF l_h, VF sample_turn2) {
  const VF width2 = hn::MulAdd(set(kLeastAlpha2OfStep2), turn2_between_rays(hits, slot, l_h), sample_turn2);
  return hn::Min(hn::Max(alpha2, hn::MulAdd(set(0.5f), alpha2, width2)), set(1.0f));
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
