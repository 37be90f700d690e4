// The surface's response to light from one direction: Lambert plus GGX (Walter et al. 2007; visibility term
// by Hammon 2017, Fresnel by Schlick).
#pragma once

#include "renderer/lighting/highlight_width-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

constexpr float kInvPi = 0.318309886f;

// Which highlights surfaces have: none, those of any dielectric or metal, or of a strength of their own
// (HitBatch::f90).
enum class Lobe : std::uint8_t { none, usual, weighted };

// Outgoing radiance per unit of irradiance along the light's direction: Lambert plus GGX, at least as wide as
// what rays and samples of the light stand for (highlight_width).
template <Lobe kLobe>
HWY_INLINE V3 reflectance(const HitBatch& hits, int slot, const V3& n, const V3& light, VF n_l,
                          VF sample_turn2) {
  const VF inv_pi = set(kInvPi);
  V3 f = scale(load3(hits.diffuse, slot), inv_pi);
  if constexpr (kLobe != Lobe::none) {
    const VF one = set(1.0f), tiny = set(1e-8f);
    const V3 v = load3(hits.viewer, slot);
    const V3 h = normalise(V3{hn::Add(light.x, v.x), hn::Add(light.y, v.y), hn::Add(light.z, v.z)});
    const VF n_v = hn::Max(hn::Abs(dot(n, v)), set(1e-4f));
    const VF n_h = dot(n, h);
    const VF l_h = hn::Max(dot(light, h), hn::Zero(kF));
    const VF alpha2 = load(&hits.alpha2[slot]), wide2 = widened(hits, slot, alpha2, l_h, sample_turn2);
    // |n x h|^2 instead of 1 - (n.h)^2: no cancellation at the peak of a smooth surface.
    const V3 c = cross(n, h);
    const VF spread = hn::Max(hn::MulAdd(hn::Mul(wide2, n_h), n_h, dot(c, c)), tiny);
    // GGX times n.h is 1 over all half vectors; what spreads light over a curved surface is 1 over all its
    // normals: that share of it takes the factor n.h. It shades nothing: alpha in `shadowing` is the
    // surface's.
    const VF height = hn::MulAdd(hn::Sub(wide2, alpha2), n_h, alpha2);
    const VF lobe = hn::Div(hn::Mul(height, inv_pi), hn::Mul(spread, spread));
    const VF alpha = hn::Sqrt(alpha2);
    const VF smooth_view = hn::Mul(set(2.0f), hn::Mul(n_l, n_v));
    const VF shadowing = hn::Div(
        set(0.5f), hn::Max(hn::MulAdd(alpha, hn::Sub(hn::Add(n_l, n_v), smooth_view), smooth_view), tiny));
    const VF k = hn::Sub(one, l_h), k2 = hn::Mul(k, k);
    const VF grazing = hn::Mul(hn::Mul(k2, k2), k);  // Schlick
    const VF common = hn::Mul(lobe, shadowing);
    VF f90 = one;
    if constexpr (kLobe == Lobe::weighted) f90 = load(&hits.f90[slot]);
    const V3 f0 = load3(hits.f0, slot);
    f = mul_add(common, mul_add(grazing, sub({f90, f90, f90}, f0), f0), f);
  }
  return f;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
