// Surfaces that reflect by their roughness: which share of light from all sides their highlight sends to the
// viewer, how much of it a mirror ray stands for, and what it shows of an environment picture. Before:
// surfaces; what lights indirectly, for the picture. After: reflections and outgoing.
// Sources: multiple scattering by Turquin, "Practical multiple scattering compensation for microfacet models"
// (2019).
#pragma once

#include "renderer/highlights/lobe_albedo.h"
#include "renderer/reflectance/sky_in_lobe-inl.h"
#include "renderer/reflectance/source_highlights-inl.h"

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

// Probes interpolate what comes from an open sky to a twentieth of it: a smaller difference tells nothing.
constexpr float kProbesTell = 0.0625f;

// What the lobe shows of the environment picture where nothing hides it, and sends on of it, per channel.
HWY_NOINLINE inline V3 shown_by_lobe(const ShadingInputs& shading, const HitBatch& hits, int slot,
                                     const LobeSeen& lobe, MF own) {
  const FilteredRecord& from = shading.filtered;
  const VF one = set(1.0f);
  const V3 albedo = load3(hits.gloss->albedo, slot);
  const LobeWidths widths = widths_of(from, hits, slot, lobe);
  const MF blurred = hn::And(own, hn::Gt(widths.filtered, hn::Zero(kF)));
  const MF mirrors = hn::And(own, hn::Lt(widths.filtered, one));
  V3 seen{one, one, one};
  if (!hn::AllFalse(kF, mirrors)) {
    const VF twice = hn::Mul(set(2.0f), dot(lobe.v, lobe.n));
    const V3 ahead = mul_add(twice, lobe.n, scale(lobe.v, set(-1.0f)));
    seen = multiply(albedo, environment_texel(shading.environment_map, ahead));
    if (hn::AllFalse(kF, blurred)) return seen;
  }
  const V3 gain = scattered_again(lobe.f0, lobe.f90, load(&hits.gloss->again[slot]));
  V3 shine = multiply(albedo, light_in_lobe(from, shading.environment_map.turn, hits, slot, lobe));
  const int small = from.small_sources, all = from.source_count;
  if (small < all) {
    const V3 lit = sources_lit(from, hits, slot, {lobe, widths.smooth2}, blurred, small, all);
    shine = mul_add(gain, lit, shine);
    const VF share = hn::Div(widths.seen2, widths.smooth2);
    const MF narrow = hn::And(blurred, hn::Lt(share, one));
    if (!hn::AllFalse(kF, narrow)) {
      const V3 core = multiply(albedo, core_of_lobe(from, hits, slot, lobe, widths));
      shine = select(narrow, mul_add(share, sub(shine, core), core), shine);
    }
  }
  if (small > 0) {
    const V3 lit = sources_lit(from, hits, slot, {lobe, widths.seen2}, blurred, 0, small);
    shine = mul_add(gain, lit, shine);
  }
  return select(mirrors, mul_add(widths.filtered, sub(shine, seen), seen), shine);
}

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
    const V3 albedo = load3(gloss.albedo, slot);
    const VF f90 = grazing_reflectance(plan, hits, slot);
    const V3 shine = shown_by_lobe(shading, hits, slot, {n, v, n_v, load3(hits.f0, slot), f90}, own);
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
