// The surface's response to light from one direction: Lambert plus GGX (Walter et al. 2007; visibility term
// by Hammon 2017, Fresnel by Schlick), and further lobes where the kernel has them.
#pragma once

#include "renderer/reflectance/further_lobes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Which highlights surfaces have: none, those of any dielectric or metal, of a strength of their own
// (HitBatch::f90), or that and whatever HitBatch::lobes holds.
enum class Lobe : std::uint8_t { none, usual, weighted, layered };

// The light's direction as the lobes of hits [slot, slot + kLanes) need it.
HWY_INLINE LobeAngles lobe_angles(const V3& n, const V3& v, const V3& light, VF n_l) {
  const V3 h = normalise(V3{hn::Add(light.x, v.x), hn::Add(light.y, v.y), hn::Add(light.z, v.z)});
  const VF zero = hn::Zero(kF);
  return {h, n_l, hn::Max(hn::Abs(dot(n, v)), set(1e-4f)), hn::Max(dot(n, h), zero),
          hn::Max(dot(light, h), zero)};
}

// The surface's own highlight but for its colour, at least as wide as what rays and samples of the light
// stand for (highlight_width).
template <Lobe kLobe>
HWY_INLINE VF base_lit(const HitBatch& hits, int slot, const LobeAngles& at, const V3& n, const V3& light,
                       VF turn2) {
  const VF alpha2 = load(&hits.alpha2[slot]), wide2 = widened(hits, slot, alpha2, at.l_h, turn2);
  VF common = ggx(at, n, alpha2, wide2);
  if constexpr (kLobe == Lobe::layered) {
    const MF stretched = hn::Gt(load(&hits.lobes->stretch[slot]), hn::Zero(kF));
    if (!hn::AllFalse(kF, stretched)) {
      const V3 v = load3(hits.viewer, slot);
      common = hn::IfThenElse(stretched, stretched_ggx(hits, slot, at, n, light, v, alpha2, wide2), common);
    }
  }
  return common;
}

// Its colour: Schlick's Fresnel.
template <Lobe kLobe>
HWY_INLINE V3 base_colour(const HitBatch& hits, int slot, VF l_h) {
  const VF one = set(1.0f), k = hn::Sub(one, l_h), k2 = hn::Mul(k, k);
  const VF grazing = hn::Mul(hn::Mul(k2, k2), k);
  VF f90 = one;
  if constexpr (kLobe >= Lobe::weighted) f90 = load(&hits.f90[slot]);
  const V3 f0 = load3(hits.f0, slot);
  return mul_add(grazing, sub({f90, f90, f90}, f0), f0);
}

// Outgoing radiance per unit of irradiance along the light's direction: Lambert, and of GGX highlights what a
// sample of the light brings of them.
template <Lobe kLobe>
HWY_INLINE V3 reflectance(const HitBatch& hits, int slot, const V3& n, const V3& light, VF n_l,
                          const HighlightParts& parts) {
  V3 f = scale(load3(hits.diffuse, slot), set(kInvPi));
  if constexpr (kLobe != Lobe::none) {
    const LobeAngles at = lobe_angles(n, load3(hits.viewer, slot), light, n_l);
    const VF common = base_lit<kLobe>(hits, slot, at, n, light, parts.base.turn2);
    f = mul_add(hn::Mul(common, parts.base.share), base_colour<kLobe>(hits, slot, at.l_h), f);
    if constexpr (kLobe == Lobe::layered) f = add(f, layers_lit(hits, slot, at, n, light, parts.coat));
  }
  return f;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
