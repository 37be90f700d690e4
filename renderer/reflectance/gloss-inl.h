// Surfaces that reflect by their roughness: which share of light from all sides their highlight sends to the
// viewer, how much of it a mirror ray stands for, and what it shows of an environment picture. Before:
// surfaces; what lights indirectly, for the picture. After: reflections and outgoing.
// Sources: multiple scattering by Turquin, "Practical multiple scattering compensation for microfacet models"
// (2019); directions within the lobe by Heitz (2018) and Dupuy & Benyoub (2023).
#pragma once

#include "renderer/environment/filtered_lookup-inl.h"
#include "renderer/highlights/disc_lobe-inl.h"
#include "renderer/highlights/lobe_albedo.h"
#include "renderer/highlights/visible_normals-inl.h"
#include "renderer/reflectance/reflectance-inl.h"

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

// Mean radiance over the lobe, per channel, without the bright sources' part of `share`.
HWY_INLINE V3 light_in_lobe(const ShadingInputs& shading, const HitBatch& hits, int slot, const V3& n,
                            const V3& v, VF n_v, const V3& f0, VF f90, VF share) {
  const VF zero = hn::Zero(kF), alpha2 = load(&hits.alpha2[slot]);
  DrawnLobe lobe;
  lobe.t = across_towards(n, v, n_v);
  lobe.alpha_t = lobe.alpha_b = hn::Sqrt(alpha2);
  set_up(lobe, n, v, n_v);
  V3 sum{zero, zero, zero}, weights = sum;
  for (const float side : {1.0f, -1.0f}) {
    const DrawnDirection at = draw(lobe, v, set(side), zero, set(kHalfLobe));
    const VF l_h = hn::Max(dot(at.direction, at.h), set(0.1f)), n_l = dot(n, at.direction);
    const VF turn2 = hn::Mul(set(0.25f), turn2_between_rays(hits, slot, l_h));
    const VF width2 = hn::MulAdd(hn::Mul(alpha2, l_h), l_h, turn2);
    const VF alpha = hn::Min(hn::Sqrt(width2), set(1.0f));
    const VF below =
        hn::Sqrt(hn::MulAdd(hn::NegMulAdd(alpha2, hn::Mul(n_l, n_l), hn::Mul(n_l, n_l)), set(1.0f), alpha2));
    const VF open = hn::Max(hn::Div(hn::Add(n_l, n_l), hn::Max(hn::Add(n_l, below), set(1e-6f))), set(1e-3f));
    const V3 light = filtered_light(shading.filtered, shading.environment_map, at.direction, alpha, share);
    const VF grazing = schlick_weight(l_h);
    const V3 weight = scale(mul_add(grazing, sub({f90, f90, f90}, f0), f0), open);
    sum = {hn::MulAdd(weight.x, light.x, sum.x), hn::MulAdd(weight.y, light.y, sum.y),
           hn::MulAdd(weight.z, light.z, sum.z)};
    weights = add(weights, weight);
  }
  const auto mean = [](VF total, VF weight) HWY_ATTR { return hn::Div(total, hn::Max(weight, set(1e-20f))); };
  return {mean(sum.x, weights.x), mean(sum.y, weights.y), mean(sum.z, weights.z)};
}

// A lobe that discs light: of a hit, or turned with the picture.
struct LitLobe {
  V3 n, v, f0;
  VF f90, alpha2;
  float least_alpha2;  // narrower ones are shown by the picture
};

struct DiscLight {
  VF lit;       // share of the irradiance, but for colour and Fresnel
  VF grazing;   // Schlick's weight
  MF near;      // the disc's shape shows
  MF in_front;  // of the surface
};

// Where the square of the lobe's width and of its distance from a source is this many times that of its rim,
// only its area shows.
constexpr float kShapeShows2 = 24.0f;

HWY_INLINE DiscLight light_of_disc(const HitBatch& hits, int slot, const LitLobe& lobe,
                                   const BrightDisc& disc) {
  const VF zero = hn::Zero(kF);
  const V3 light = set3(disc.direction);
  const VF n_l = dot(lobe.n, light);
  DiscLight out{zero, zero, first_lanes(0), hn::Gt(n_l, zero)};
  if (hn::AllFalse(kF, out.in_front)) return out;
  const LobeAngles at = lobe_angles(lobe.n, lobe.v, light, hn::Max(n_l, zero));
  const VF turn2 = hn::Mul(set(0.25f), turn2_between_rays(hits, slot, at.l_h));
  const VF wide2 = hn::Max(hn::Add(lobe.alpha2, turn2), set(lobe.least_alpha2));
  // Across the plane of light and viewer half vectors turn by 1 / l.h more: a disc of the same area.
  const VF rim2 = hn::Div(set(disc.half_turn2), hn::Max(at.l_h, set(0.1f)));
  const V3 off = cross(lobe.n, at.h);
  // GGX is alpha^2 over the square of |n x h|^2 + (alpha n.h)^2. What spreads light over a curved surface is
  // weighed by n.h, as in ggx().
  const VF n_h2 = hn::Max(hn::Mul(at.n_h, at.n_h), set(1e-6f));
  const VF off2 = dot(off, off), height2 = hn::Mul(wide2, n_h2);
  const VF weighed = hn::Div(hn::MulAdd(turn2, at.n_h, hn::Sub(wide2, turn2)), height2);
  const VF d = hn::Mul(ggx_over_disc(off2, height2, rim2), weighed);
  out.lit = hn::Mul(d, hn::Mul(visibility(at, lobe.alpha2), at.n_l));
  out.grazing = schlick_weight(at.l_h);
  out.near = hn::Gt(hn::Mul(set(kShapeShows2), rim2), hn::Add(off2, height2));
  return out;
}

HWY_INLINE V3 coloured(const LitLobe& lobe, const DiscLight& by, const float* irradiance) {
  const V3 f90{lobe.f90, lobe.f90, lobe.f90};
  return multiply(scale(mul_add(by.grazing, sub(f90, lobe.f0), lobe.f0), by.lit), set3(irradiance));
}

HWY_NOINLINE inline V3 lit_by_parts(const FilteredRecord& from, const HitBatch& hits, int slot,
                                    const LitLobe& lobe, const BrightSource& source) {
  // The picture's own directions: turned clockwise by its turn.
  const auto unturned = [&](const V3& d) HWY_ATTR -> V3 {
    const VF c = set(from.turn_cosine), s = set(from.turn_sine);
    return {hn::NegMulAdd(s, d.z, hn::Mul(c, d.x)), d.y, hn::MulAdd(s, d.x, hn::Mul(c, d.z))};
  };
  LitLobe turned = lobe;
  turned.n = unturned(lobe.n);
  turned.v = unturned(lobe.v);
  V3 sum{hn::Zero(kF), hn::Zero(kF), hn::Zero(kF)};
  for (int i = source.first_part; i < source.first_part + source.parts; ++i) {
    const DiscLight by = light_of_disc(hits, slot, turned, from.parts[i]);
    sum = add(sum, coloured(turned, by, from.parts[i].irradiance));
  }
  return sum;
}

// Highlights of the bright sources, which the lobe takes by themselves: as discs, and near each of those as
// the parts that it is made of.
HWY_INLINE V3 sources_lit(const FilteredRecord& from, const HitBatch& hits, int slot, const LitLobe& lobe,
                          MF lanes) {
  V3 sum{hn::Zero(kF), hn::Zero(kF), hn::Zero(kF)};
  for (int i = 0; i < from.source_count; ++i) {
    const BrightSource& source = from.sources[i];
    const DiscLight by = light_of_disc(hits, slot, lobe, source);
    if (hn::AllFalse(kF, by.in_front)) continue;
    V3 lit = coloured(lobe, by, source.irradiance);
    const MF near = hn::And(by.near, lanes);
    if (source.parts > 1 && !hn::AllFalse(kF, near)) {
      lit = select(near, lit_by_parts(from, hits, slot, lobe, source), lit);
    }
    sum = add(sum, lit);
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
    const VF alpha2 = load(&hits.alpha2[slot]);
    const VF turn2 = hn::Mul(set(0.25f), turn2_between_rays(hits, slot, n_v));
    const VF by_levels = filtered_share(shading.filtered, hn::Add(alpha2, turn2));
    V3 shine = multiply(albedo, light_in_lobe(shading, hits, slot, n, v, n_v, f0, f90, by_levels));
    const MF sees_sources = hn::And(own, hn::Gt(by_levels, zero));
    if (shading.filtered.source_count > 0 && !hn::AllFalse(kF, sees_sources)) {
      const V3 gain = scattered_again(f0, f90, load(&gloss.again[slot]));
      const float least = shading.filtered.first_alpha * shading.filtered.first_alpha;
      const LitLobe lobe{n, v, f0, f90, alpha2, least};
      const V3 lit = multiply(gain, sources_lit(shading.filtered, hits, slot, lobe, sees_sources));
      shine = mul_add(by_levels, lit, shine);
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
