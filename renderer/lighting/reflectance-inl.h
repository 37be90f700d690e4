// The surface's response to light from one direction: Lambert plus GGX (Walter et al. 2007; visibility term
// by Hammon 2017, Fresnel by Schlick), and further lobes where the kernel has them.
#pragma once

#include "renderer/lighting/further_lobes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Which highlights surfaces have: none, those of any dielectric or metal, of a strength of their own
// (HitBatch::f90), or that and whatever HitBatch::lobes holds.
enum class Lobe : std::uint8_t { none, usual, weighted, layered };

// Outgoing radiance per unit of irradiance along the light's direction: Lambert plus GGX, at least as wide as
// what rays and samples of the light stand for (highlight_width).
template <Lobe kLobe>
HWY_INLINE V3 reflectance(const HitBatch& hits, int slot, const V3& n, const V3& light, VF n_l,
                          VF sample_turn2) {
  const VF inv_pi = set(kInvPi);
  V3 f = scale(load3(hits.diffuse, slot), inv_pi);
  if constexpr (kLobe != Lobe::none) {
    const VF one = set(1.0f);
    const V3 v = load3(hits.viewer, slot);
    const V3 h = normalise(V3{hn::Add(light.x, v.x), hn::Add(light.y, v.y), hn::Add(light.z, v.z)});
    const VF zero = hn::Zero(kF);
    const LobeAngles at{h, n_l, hn::Max(hn::Abs(dot(n, v)), set(1e-4f)), hn::Max(dot(n, h), zero),
                        hn::Max(dot(light, h), zero)};
    const VF alpha2 = load(&hits.alpha2[slot]), wide2 = widened(hits, slot, alpha2, at.l_h, sample_turn2);
    VF common = ggx(at, n, alpha2, wide2);
    if constexpr (kLobe == Lobe::layered) {
      const MF stretched = hn::Gt(load(&hits.lobes->stretch[slot]), hn::Zero(kF));
      if (!hn::AllFalse(kF, stretched)) {
        common = hn::IfThenElse(stretched, stretched_ggx(hits, slot, at, n, light, v, alpha2, wide2), common);
      }
    }
    const VF k = hn::Sub(one, at.l_h), k2 = hn::Mul(k, k);
    const VF grazing = hn::Mul(hn::Mul(k2, k2), k);  // Schlick
    VF f90 = one;
    if constexpr (kLobe >= Lobe::weighted) f90 = load(&hits.f90[slot]);
    const V3 f0 = load3(hits.f0, slot);
    f = mul_add(common, mul_add(grazing, sub({f90, f90, f90}, f0), f0), f);
    if constexpr (kLobe == Lobe::layered) {
      const V3 layers = layers_lit(hits, slot, at, n, light, sample_turn2);
      f = {hn::Add(f.x, layers.x), hn::Add(f.y, layers.y), hn::Add(f.z, layers.z)};
    }
  }
  return f;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
