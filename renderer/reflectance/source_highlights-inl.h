// Highlights of the bright sources of an environment picture, in closed form. Before: environment/ took them
// out of the picture. After: gloss-inl.h.
#pragma once

#include "renderer/highlights/disc_lobe-inl.h"
#include "renderer/reflectance/reflectance-inl.h"
#include "renderer/reflectance/sky_in_lobe-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// A lobe that discs light: of a hit, or turned with the picture.
struct LitLobe {
  LobeSeen seen;
  VF least2;  // square of alpha: narrower ones are taken for as wide
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
  const V3 light = set3(disc.direction), n = lobe.seen.n;
  const VF n_l = dot(n, light);
  DiscLight out{zero, zero, first_lanes(0), hn::Gt(n_l, zero)};
  if (hn::AllFalse(kF, out.in_front)) return out;
  const LobeAngles at = lobe_angles(n, lobe.seen.v, light, hn::Max(n_l, zero));
  const VF alpha2 = load(&hits.alpha2[slot]);
  const VF turn2 = hn::Mul(set(0.25f), turn2_between_rays(hits, slot, at.l_h));
  const VF wide2 = hn::Max(hn::Add(alpha2, turn2), lobe.least2);
  // Across the plane of light and viewer half vectors turn by 1 / l.h more: a disc of the same area.
  const VF rim2 = hn::Div(set(disc.half_turn2), hn::Max(at.l_h, set(0.1f)));
  const V3 off = cross(n, at.h);
  // GGX is alpha^2 over the square of |n x h|^2 + (alpha n.h)^2. What spreads light over a curved surface is
  // weighed by n.h, as in ggx().
  const VF n_h2 = hn::Max(hn::Mul(at.n_h, at.n_h), set(1e-6f));
  const VF off2 = dot(off, off), height2 = hn::Mul(wide2, n_h2);
  const VF weighed = hn::Div(hn::MulAdd(turn2, at.n_h, hn::Sub(wide2, turn2)), height2);
  const VF d = hn::Mul(ggx_over_disc(off2, height2, rim2), weighed);
  out.lit = hn::Mul(d, hn::Mul(visibility(at, alpha2), at.n_l));
  out.grazing = schlick_weight(at.l_h);
  out.near = hn::Gt(hn::Mul(set(kShapeShows2), rim2), hn::Add(off2, height2));
  return out;
}

HWY_INLINE V3 coloured(const LitLobe& lobe, const DiscLight& by, const float* irradiance) {
  const V3 f0 = lobe.seen.f0, f90{lobe.seen.f90, lobe.seen.f90, lobe.seen.f90};
  return multiply(scale(mul_add(by.grazing, sub(f90, f0), f0), by.lit), set3(irradiance));
}

HWY_NOINLINE inline V3 lit_by_parts(const FilteredRecord& from, const HitBatch& hits, int slot,
                                    const LitLobe& lobe, const BrightSource& source) {
  // The picture's own directions: turned clockwise by its turn.
  const auto unturned = [&](const V3& d) HWY_ATTR -> V3 {
    const VF c = set(from.turn_cosine), s = set(from.turn_sine);
    return {hn::NegMulAdd(s, d.z, hn::Mul(c, d.x)), d.y, hn::MulAdd(s, d.x, hn::Mul(c, d.z))};
  };
  LitLobe turned = lobe;
  turned.seen.n = unturned(lobe.seen.n);
  turned.seen.v = unturned(lobe.seen.v);
  V3 sum{hn::Zero(kF), hn::Zero(kF), hn::Zero(kF)};
  for (int i = source.first_part; i < source.first_part + source.parts; ++i) {
    const DiscLight by = light_of_disc(hits, slot, turned, from.parts[i]);
    sum = add(sum, coloured(turned, by, from.parts[i].irradiance));
  }
  return sum;
}

// Highlights of bright sources [first, last), which the lobe takes by themselves: as discs, and near each of
// those as the parts that it is made of. Other lanes than `lanes` matter to nobody.
HWY_NOINLINE inline V3 sources_lit(const FilteredRecord& from, const HitBatch& hits, int slot,
                                   const LitLobe& lobe, MF lanes, int first, int last) {
  V3 sum{hn::Zero(kF), hn::Zero(kF), hn::Zero(kF)};
  for (int i = first; i < last; ++i) {
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

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
