// Surfaces that reflect by their roughness: which share of light from all sides their highlight sends to the
// viewer, how much of it a mirror ray stands for, and what it shows of an environment picture. Before:
// surfaces; what lights indirectly, for the picture. After: reflections and outgoing.
// Sources: multiple scattering by Turquin, "Practical multiple scattering compensation for microfacet models"
// (2019); directions within the lobe by Heitz (2018) and Dupuy & Benyoub (2023).
#pragma once

#include "renderer/environment/filtered_lookup-inl.h"
#include "renderer/highlights/lobe_albedo.h"
#include "renderer/highlights/visible_normals-inl.h"
#include "renderer/lighting/reflectance-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// kLobeAlbedoAll and kLobeAlbedoGrazing at a cosine and a roughness, each in [0, 1].
struct LobeAlbedo {
  VF all, grazing;
};
HWY_INLINE LobeAlbedo lobe_albedo(VF cosine, VF roughness) {
  const VF x = hn::Mul(cosine, set(static_cast<float>(kAlbedoCosines - 1)));
  const VF y = hn::Mul(roughness, set(static_cast<float>(kAlbedoRoughnesses - 1)));
  const VF column = hn::Min(hn::Floor(x), set(static_cast<float>(kAlbedoCosines - 2)));
  const VF row = hn::Min(hn::Floor(y), set(static_cast<float>(kAlbedoRoughnesses - 2)));
  const VI first = hn::ConvertTo(kI, hn::MulAdd(row, set(static_cast<float>(kAlbedoCosines)), column));
  const VF tx = hn::Sub(x, column), ty = hn::Sub(y, row);
  const auto mix = [](VF a, VF b, VF t) HWY_ATTR { return hn::MulAdd(t, hn::Sub(b, a), a); };
  const auto in_row = [&](const float* at) HWY_ATTR {
    return mix(hn::GatherIndex(kF, at, first), hn::GatherIndex(kF, at + 1, first), tx);
  };
  const auto in_table = [&](const float* at)
                            HWY_ATTR { return mix(in_row(at), in_row(at + kAlbedoCosines), ty); };
  return {in_table(kLobeAlbedoAll), in_table(kLobeAlbedoGrazing)};
}

// F90 of hits; where no highlight is weighed it is 1.
HWY_INLINE VF grazing_reflectance(const FramePlan& plan, const HitBatch& hits, int slot) {
  return plan.surface_details ? load(&hits.f90[slot]) : set(1.0f);
}

// Light that met the surface more than once adds F0 (1 - E) / E to the highlight: what it is multiplied by.
HWY_INLINE V3 scattered_again(const V3& f0, VF f90, VF again) {
  const VF one = set(1.0f), share = hn::Div(again, hn::Max(f90, set(1e-6f)));
  return {hn::MulAdd(f0.x, share, one), hn::MulAdd(f0.y, share, one), hn::MulAdd(f0.z, share, one)};
}

// Hits [0, count): Gloss::albedo, `held_back` and `again`. Once per batch, before further lobes cover the
// base. Where no mirror ray is traced (`followed` is false), none stands for anything.
HWY_NOINLINE inline void prepare_gloss(const FramePlan& plan, HitBatch& hits, int count, bool followed) {
  Gloss& gloss = *hits.gloss;
  const VF zero = hn::Zero(kF), one = set(1.0f);
  for (int slot = 0; slot < count; slot += kLanes) {
    const MF surface = hn::Or(of_kind(hits, slot, HitKind::object), of_kind(hits, slot, HitKind::catcher));
    if (hn::AllFalse(kF, surface)) continue;
    const MF own = hn::And(surface, hn::Gt(load(&gloss.own[slot]), zero));
    if (!followed) hn::Store(hn::IfThenZeroElse(own, load(&hits.mirror[slot])), kF, &hits.mirror[slot]);
    if (hn::AllFalse(kF, own)) continue;
    const VF cosine = hn::Abs(dot(load3(hits.normal, slot), load3(hits.viewer, slot)));
    const VF roughness = hn::Sqrt(hn::Sqrt(hn::IfThenElseZero(own, load(&hits.alpha2[slot]))));
    const LobeAlbedo at = lobe_albedo(hn::IfThenElseZero(own, hn::Min(cosine, one)), hn::Min(roughness, one));
    const VF again = hn::Div(hn::Sub(one, at.all), at.all);
    const V3 f0 = load3(hits.f0, slot);
    const VF f90 = grazing_reflectance(plan, hits, slot), head_on = hn::Sub(at.all, at.grazing);
    const V3 gain = scattered_again(f0, f90, again);
    const auto share = [&](VF reflects, VF more) HWY_ATTR {
      return hn::Mul(hn::MulAdd(reflects, head_on, hn::Mul(f90, at.grazing)), more);
    };
    store3(only(own, {share(f0.x, gain.x), share(f0.y, gain.y), share(f0.z, gain.z)}), gloss.albedo, slot);
    const VF dielectric = load(&hits.held_back[slot]);
    hn::Store(share(dielectric, hn::MulAdd(dielectric, again, one)), kF, &gloss.held_back[slot]);
    hn::Store(again, kF, &gloss.again[slot]);
  }
}

// One direction for each half of the lobe: cut along the plane of normal and viewer, in which it is longest,
// each half stands at this share of the area of visible normals, and is as wide as the lobe is across.
constexpr float kHalfLobe = 0.12f;

struct LobeLight {
  V3 radiance;  // mean over the lobe, per channel
  VF sources;   // share of the bright sources that is not in it
};

HWY_INLINE LobeLight light_in_lobe(const ShadingInputs& shading, const HitBatch& hits, int slot, const V3& n,
                                   const V3& v, VF n_v, const V3& f0, VF f90) {
  const VF zero = hn::Zero(kF), alpha2 = load(&hits.alpha2[slot]);
  DrawnLobe lobe;
  lobe.t = across_towards(n, v, n_v);
  lobe.alpha_t = lobe.alpha_b = hn::Sqrt(alpha2);
  set_up(lobe, n, v, n_v);
  V3 sum{zero, zero, zero}, weights = sum;
  VF apart = zero, all = zero;
  for (const float side : {1.0f, -1.0f}) {
    const DrawnDirection at = draw(lobe, v, set(side), zero, set(kHalfLobe));
    const VF l_h = hn::Max(dot(at.direction, at.h), set(0.1f)), n_l = dot(n, at.direction);
    const VF turn2 = hn::Mul(set(0.25f), turn2_between_rays(hits, slot, l_h));
    const VF width2 = hn::MulAdd(hn::Mul(alpha2, l_h), l_h, turn2);
    const VF alpha = hn::Min(hn::Sqrt(width2), set(1.0f));
    const VF below =
        hn::Sqrt(hn::MulAdd(hn::NegMulAdd(alpha2, hn::Mul(n_l, n_l), hn::Mul(n_l, n_l)), set(1.0f), alpha2));
    const VF open = hn::Max(hn::Div(hn::Add(n_l, n_l), hn::Max(hn::Add(n_l, below), set(1e-6f))), set(1e-3f));
    const FilteredLight light =
        filtered_light(shading.filtered, shading.environment_map, at.direction, alpha);
    const VF grazing = schlick_weight(l_h);
    const V3 weight = scale(mul_add(grazing, sub({f90, f90, f90}, f0), f0), open);
    sum = {hn::MulAdd(weight.x, light.radiance.x, sum.x), hn::MulAdd(weight.y, light.radiance.y, sum.y),
           hn::MulAdd(weight.z, light.radiance.z, sum.z)};
    weights = add(weights, weight);
    apart = hn::MulAdd(open, light.sources, apart);
    all = hn::Add(all, open);
  }
  const auto mean = [](VF total, VF weight) HWY_ATTR { return hn::Div(total, hn::Max(weight, set(1e-20f))); };
  return {{mean(sum.x, weights.x), mean(sum.y, weights.y), mean(sum.z, weights.z)}, hn::Div(apart, all)};
}

// Highlights of the bright sources, which the lobe takes by themselves.
HWY_INLINE V3 sources_lit(const ShadingInputs& shading, const HitBatch& hits, int slot, const V3& n,
                          const V3& v, const V3& f0, VF f90) {
  const VF zero = hn::Zero(kF), alpha2 = load(&hits.alpha2[slot]);
  V3 sum{zero, zero, zero};
  for (int i = 0; i < shading.filtered.source_count; ++i) {
    const BrightSource& source = shading.filtered.sources[i];
    const V3 light = set3(source.direction);
    const VF n_l = dot(n, light);
    if (hn::AllFalse(kF, hn::Gt(n_l, zero))) continue;
    const LobeAngles at = lobe_angles(n, v, light, hn::Max(n_l, zero));
    const VF turn2 = hn::MulAdd(set(0.25f), turn2_between_rays(hits, slot, at.l_h), set(source.half_turn2));
    const VF common = hn::Mul(ggx(at, n, alpha2, hn::Add(alpha2, turn2)), at.n_l);
    const V3 colour = mul_add(schlick_weight(at.l_h), sub({f90, f90, f90}, f0), f0);
    sum = add(sum, multiply(scale(colour, common), set3(source.irradiance)));
  }
  return sum;
}

// Probes interpolate what comes from an open sky to a twentieth of it: a smaller difference tells nothing.
constexpr float kProbesTell = 0.0625f;

// What highlights of hits [0, count) show of the environment picture, and of light from all sides: where
// probes know of less light than the picture sends to the hit, evenly, the rest is hidden, and what they know
// beyond it comes evenly from other surfaces.
HWY_NOINLINE inline void show_environment(const ShadingInputs& shading, HitBatch& hits, int count) {
  Gloss& gloss = *hits.gloss;
  const FramePlan& plan = *shading.plan;
  const VF zero = hn::Zero(kF), one = set(1.0f);
  for (int slot = 0; slot < count; slot += kLanes) {
    const MF own = hn::And(of_kind(hits, slot, HitKind::object), hn::Gt(load(&gloss.own[slot]), zero));
    if (hn::AllFalse(kF, own)) continue;
    const V3 ahead{zero, zero, one};
    const V3 n = select(own, load3(hits.normal, slot), ahead),
             v = select(own, load3(hits.viewer, slot), ahead);
    const VF n_v = hn::Min(hn::Max(hn::Abs(dot(n, v)), set(1e-4f)), one);
    const V3 f0 = load3(hits.f0, slot), albedo = load3(gloss.albedo, slot);
    const VF f90 = grazing_reflectance(plan, hits, slot);
    const LobeLight lobe = light_in_lobe(shading, hits, slot, n, v, n_v, f0, f90);
    V3 shine = multiply(albedo, lobe.radiance);
    if (shading.filtered.source_count > 0 && !hn::AllFalse(kF, hn::And(own, hn::Gt(lobe.sources, zero)))) {
      const V3 gain = scattered_again(f0, f90, load(&gloss.again[slot]));
      const V3 lit = multiply(gain, sources_lit(shading, hits, slot, n, v, f0, f90));
      shine = mul_add(lobe.sources, lit, shine);
    }
    store3(only(own, shine), gloss.shine, slot);
    V3 around = shine;
    if (shading.probes != nullptr) {
      const V3 sent = environment_texel(shading.filtered.even, n), known = load3(hits.indirect, slot);
      const auto channel = [&](VF sky, VF share, VF all, VF here) HWY_ATTR {
        const VF least = hn::Mul(all, set(1.0f - kProbesTell)), most = hn::Mul(all, set(1.0f + kProbesTell));
        const VF seen = hn::Min(hn::Div(here, hn::Max(least, set(1e-20f))), one);
        return hn::MulAdd(share, hn::Max(hn::Sub(here, most), zero), hn::Mul(sky, seen));
      };
      around = {channel(shine.x, albedo.x, sent.x, known.x), channel(shine.y, albedo.y, sent.y, known.y),
                channel(shine.z, albedo.z, sent.z, known.z)};
    }
    store3(only(own, around), gloss.around, slot);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
