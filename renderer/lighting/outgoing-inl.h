// Lit surfaces -> the radiance that they send back along their rays. After: direct_light and what lights
// indirectly; before: resolve (first hits), second_rays (second hits).
#pragma once

#include "renderer/reflectance/further_lobes-inl.h"
#include "renderer/reflectance/interfaces-inl.h"
#include "renderer/simd/simd_types-inl.h"
#include "renderer/tiles/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Share of the light from all sides that a surface scatters back. Constant ambient light meets diffuse and
// specular reflectance in full (held_back = 0); light from probes never leaves stronger than it came: what a
// dielectric's highlights send back does not reach its diffuse layer, and a metal has none.
HWY_INLINE VF scattered_share(VF diffuse, VF reflects, VF unfollowed, VF held_back) {
  return hn::MulAdd(hn::NegMulAdd(held_back, diffuse, reflects), unfollowed, diffuse);
}

// Share of light from all sides that reaches hits [slot, slot + kLanes): by short rays, by the occlusion
// texture, or the smaller where both are there, which tell of the same neighbours.
HWY_INLINE VF open_share(const HitBatch& hits, int slot, const FramePlan& plan, bool occlusion_traced) {
  const VF one = set(1.0f);
  const VF traced = occlusion_traced ? hn::Max(load(&hits.open[slot]), hn::Zero(kF)) : one;
  return plan.surface_details ? hn::Min(traced, load(&hits.occlusion[slot])) : traced;
}

// What a surface reflects as a mirror does, per channel, and the share of it that no mirror ray stands for.
struct SpecularShare {
  V3 reflects;
  VF unfollowed;
  VF diffuse;    // share of light from all sides that gets past the highlight to what scatters below
  VF held_back;  // of that, where light comes evenly
  V3 around;     // radiance that comes by the lobe itself
};

// Surfaces that reflect by their roughness: what is mirrored does not reach the diffuse layer. In a filtered
// environment all of the highlight comes by its lobe.
HWY_INLINE void take_gloss(const HitBatch& hits, int slot, const FramePlan& plan, SpecularShare& out) {
  const VF zero = hn::Zero(kF), one = set(1.0f);
  const MF own = hn::Gt(load(&hits.gloss->own[slot]), zero);
  if (hn::AllFalse(kF, own)) return;
  const VF share = plan.filtered_environment ? one : hn::Sub(one, out.unfollowed);
  const VF past = hn::NegMulAdd(share, hn::Min(load(&hits.gloss->held_back[slot]), one), one);
  out.diffuse = hn::IfThenElse(own, past, out.diffuse);
  if (!plan.filtered_environment) return;
  out.reflects = only(hn::Not(own), out.reflects);
  out.held_back = hn::IfThenZeroElse(own, out.held_back);
  out.around = scale(only(own, load3(hits.gloss->around, slot)), out.unfollowed);
}

// F0, but for glass whose light is followed: there, what does not pass at this angle. Total reflection is
// followed whole.
HWY_INLINE SpecularShare specular_share(const HitBatch& hits, int slot, const ShadingInputs& shading,
                                        bool mirror_traced) {
  const FramePlan& plan = *shading.plan;
  const VF zero = hn::Zero(kF), one = set(1.0f);
  const VF held_back = shading.probes != nullptr ? load(&hits.held_back[slot]) : zero;
  SpecularShare out{load3(hits.f0, slot),
                    mirror_traced ? hn::Sub(one, load(&hits.mirror[slot])) : one,
                    one,
                    held_back,
                    {zero, zero, zero}};
  if (plan.gloss) take_gloss(hits, slot, plan, out);
  if (!plan.refraction) return out;
  const MF clear =
      hn::And(of_kind(hits, slot, HitKind::object), hn::Gt(load(&hits.transmission[slot]), hn::Zero(kF)));
  if (hn::AllFalse(kF, clear)) return out;
  const Interface at = interface_at(hits, slot, plan.surface_details);
  out.reflects = select(clear, at.reflects, out.reflects);
  out.unfollowed = hn::IfThenZeroElse(hn::And(clear, at.total), out.unfollowed);
  return out;
}

// Radiance that hits [slot, slot + kLanes) send back: emission, direct light, and light from all sides
// (constant, or from probes). The mirror ray stands for the mirror's share of the specular ambient light,
// where one is traced; ambient light reaches the `open` share of a hit.
HWY_INLINE V3 outgoing(const HitBatch& hits, int slot, const ShadingInputs& shading, bool mirror_traced,
                       bool occlusion_traced) {
  const bool probes = shading.probes != nullptr;
  const SpecularShare specular = specular_share(hits, slot, shading, mirror_traced);
  const VF open = open_share(hits, slot, *shading.plan, occlusion_traced);
  const VF none = hn::Zero(kF);
  const V3 layers = shading.plan->further_lobes ? layers_share(hits, slot) : V3{none, none, none};
  const auto channel = [&](const Lane<float>& emission, const Lane<float>& diffuse, VF reflects,
                           const Lane<float>& direct, const Lane<float>& indirect, VF layer, VF by_lobe,
                           float ambient) HWY_ATTR {
    const VF around = probes ? load(&indirect[slot]) : set(ambient);
    const VF under = hn::Mul(load(&diffuse[slot]), specular.diffuse);
    const VF scattered =
        hn::Add(layer, scattered_share(under, reflects, specular.unfollowed, specular.held_back));
    const VF received = hn::MulAdd(scattered, hn::Mul(open, around), load(&direct[slot]));
    return hn::Add(load(&emission[slot]), hn::MulAdd(open, by_lobe, received));
  };
  return {channel(hits.emission.x, hits.diffuse.x, specular.reflects.x, hits.direct.x, hits.indirect.x,
                  layers.x, specular.around.x, shading.ambient[0]),
          channel(hits.emission.y, hits.diffuse.y, specular.reflects.y, hits.direct.y, hits.indirect.y,
                  layers.y, specular.around.y, shading.ambient[1]),
          channel(hits.emission.z, hits.diffuse.z, specular.reflects.z, hits.direct.z, hits.indirect.z,
                  layers.z, specular.around.z, shading.ambient[2])};
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
