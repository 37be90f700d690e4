// What few surfaces have beyond diffuse and one highlight: a clear coat over all, sheen over the base, and a
// highlight that is longer along one direction. Before: surfaces fills HitBatch::lobes. After: reflectance
// adds them to direct light, outgoing to light from all sides. Compiled into the kernels of scenes that have
// them. Sources: KHR_materials_clearcoat, _sheen (Estevez & Kulla, "Production Friendly Microfacet Sheen
// BRDF", 2017), _anisotropy (Heitz, "Understanding the Masking-Shadowing Function", 2014).
#pragma once

#include <hwy/contrib/math/math-inl.h>

#include "renderer/highlights/highlight_width-inl.h"
#include "renderer/reflectance/interfaces-inl.h"
#include "renderer/reflectance/sheen_albedo.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

constexpr float kInvPi = 0.318309886f;
constexpr float kCoatF0 = 0.04f;  // index 1.5

// One light's direction as a lobe needs it; `n` is the lobe's normal. None is negative: at a silhouette an
// interpolated normal can lie behind the viewer, and the half vector behind it.
struct LobeAngles {
  V3 h;
  VF n_l, n_v, n_h, l_h;
};

// Hammon's visibility: masking of both ways over 4 n.l n.v.
HWY_INLINE VF visibility(const LobeAngles& at, VF alpha2) {
  const VF tiny = set(1e-8f), alpha = hn::Sqrt(alpha2);
  const VF smooth_view = hn::Mul(set(2.0f), hn::Mul(at.n_l, at.n_v));
  return hn::Div(
      set(0.5f),
      hn::Max(hn::MulAdd(alpha, hn::Sub(hn::Add(at.n_l, at.n_v), smooth_view), smooth_view), tiny));
}

// GGX times visibility, of `alpha2`, at least as wide as rays and samples (see reflectance).
HWY_INLINE VF ggx(const LobeAngles& at, const V3& n, VF alpha2, VF wide2) {
  const VF tiny = set(1e-8f);
  // |n x h|^2 instead of 1 - (n.h)^2: no cancellation at the peak of a smooth surface.
  const V3 c = cross(n, at.h);
  const VF spread = hn::Max(hn::MulAdd(hn::Mul(wide2, at.n_h), at.n_h, dot(c, c)), tiny);
  // GGX times n.h is 1 over all half vectors; what spreads light over a curved surface is 1 over all its
  // normals: that share of it takes the factor n.h. It shades nothing: alpha in `visibility` is the
  // surface's.
  const VF height = hn::MulAdd(hn::Sub(wide2, alpha2), at.n_h, alpha2);
  const VF lobe = hn::Div(hn::Mul(height, set(kInvPi)), hn::Mul(spread, spread));
  return hn::Mul(lobe, visibility(at, alpha2));
}

// KHR_materials_anisotropy: alpha along the tangent is mix(alpha, 1, strength^2), across it alpha.
HWY_INLINE VF alpha_along(VF alpha, VF strength) {
  return hn::MulAdd(hn::Mul(strength, strength), hn::Sub(set(1.0f), alpha), alpha);
}

HWY_INLINE VF stretched_ggx(const HitBatch& hits, int slot, const LobeAngles& at, const V3& n,
                            const V3& light, const V3& v, VF alpha2, VF wide2) {
  const VF strength = load(&hits.lobes->stretch[slot]);
  const V3 t = load3(hits.lobes->tangent, slot);
  const V3 b = cross(n, t);
  const VF wide_b = hn::Sqrt(wide2), wide_t = alpha_along(wide_b, strength);
  const VF both = hn::Mul(wide_t, wide_b);
  const V3 f{hn::Mul(wide_b, dot(t, at.h)), hn::Mul(wide_t, dot(b, at.h)), hn::Mul(both, at.n_h)};
  const VF w2 = hn::Div(both, hn::Max(dot(f, f), set(1e-20f)));
  const VF share = hn::Div(hn::MulAdd(hn::Sub(wide2, alpha2), at.n_h, alpha2), wide2);
  const VF lobe = hn::Mul(hn::Mul(both, share), hn::Mul(set(kInvPi), hn::Mul(w2, w2)));
  const VF alpha_b = hn::Sqrt(alpha2), alpha_t = alpha_along(alpha_b, strength);
  const auto masked = [&](const V3& way, VF cosine) HWY_ATTR {
    const V3 scaled{hn::Mul(alpha_t, dot(t, way)), hn::Mul(alpha_b, dot(b, way)), cosine};
    return hn::Sqrt(dot(scaled, scaled));
  };
  const VF sum = hn::MulAdd(at.n_l, masked(v, at.n_v), hn::Mul(at.n_v, masked(light, at.n_l)));
  return hn::Mul(lobe, hn::Div(set(0.5f), hn::Max(sum, set(1e-8f))));
}

HWY_INLINE VF power(VF base, VF exponent) {
  const VF logarithm = hn::Log(kF, hn::Max(base, set(1e-30f)));
  return hn::Exp(kF, hn::Max(hn::Mul(exponent, logarithm), set(-80.0f)));
}

// Lambda of Charlie's masking at a cosine, by the fit of Estevez & Kulla.
HWY_INLINE VF charlie_lambda(VF cosine, VF alpha) {
  const VF rest = hn::Sub(set(1.0f), alpha), t = hn::Mul(rest, rest);
  const auto between = [&](float rough, float smooth)
                           HWY_ATTR { return hn::MulAdd(t, set(smooth - rough), set(rough)); };
  const VF a = between(21.5473f, 25.3245f), b = between(3.82987f, 3.32435f), c = between(0.19823f, 0.16801f),
           d = between(-1.97760f, -1.27393f), e = between(-4.32054f, -4.85967f);
  const auto fit = [&](VF x) HWY_ATTR {
    return hn::Add(hn::Div(a, hn::MulAdd(b, power(x, c), set(1.0f))), hn::MulAdd(d, x, e));
  };
  const MF low = hn::Lt(cosine, set(0.5f));
  const VF at = fit(hn::IfThenElse(low, cosine, hn::Sub(set(1.0f), cosine)));
  const VF middle = fit(set(0.5f));
  return hn::Exp(kF, hn::IfThenElse(low, at, hn::Sub(hn::Add(middle, middle), at)));
}

HWY_INLINE VF sheen_alpha(const HitBatch& hits, int slot) {
  return hn::Max(load(&hits.lobes->sheen_alpha[slot]), set(kSmallestSheenAlpha));
}

// White sheen: Charlie's distribution times its visibility.
HWY_INLINE VF charlie(const HitBatch& hits, int slot, const LobeAngles& at, const V3& n) {
  const VF alpha = sheen_alpha(hits, slot), per_alpha = hn::Div(set(1.0f), alpha);
  const V3 c = cross(n, at.h);
  const VF lobe = hn::Mul(hn::Mul(hn::Add(set(2.0f), per_alpha), set(0.5f * kInvPi)),
                          power(dot(c, c), hn::Mul(set(0.5f), per_alpha)));
  const VF masking =
      hn::Add(set(1.0f), hn::Add(charlie_lambda(at.n_v, alpha), charlie_lambda(at.n_l, alpha)));
  return hn::Div(lobe, hn::Max(hn::Mul(masking, hn::Mul(set(4.0f), hn::Mul(at.n_l, at.n_v))), set(1e-8f)));
}

// kSheenAlbedo at each hit, seen by its viewer.
HWY_INLINE VF sheen_share(const HitBatch& hits, int slot) {
  const VF cosine = hn::Abs(dot(load3(hits.normal, slot), load3(hits.viewer, slot)));
  const auto place = [](VF square) HWY_ATTR {
    const VF most = set(static_cast<float>(kSheenSteps - 1));
    return hn::Min(hn::Mul(hn::Sqrt(square), most), most);
  };
  const VF x = place(cosine), y = place(sheen_alpha(hits, slot));
  const VF last = set(static_cast<float>(kSheenSteps - 2));
  const VF column = hn::Min(hn::Floor(x), last), row = hn::Min(hn::Floor(y), last);
  const VI first = hn::ConvertTo(kI, hn::MulAdd(row, set(static_cast<float>(kSheenSteps)), column));
  const auto mix = [](VF a, VF b, VF t) HWY_ATTR { return hn::MulAdd(t, hn::Sub(b, a), a); };
  const auto in_row = [&](const float* at) HWY_ATTR {
    return mix(hn::GatherIndex(kF, at, first), hn::GatherIndex(kF, at + 1, first), hn::Sub(x, column));
  };
  return mix(in_row(kSheenAlbedo), in_row(kSheenAlbedo + kSheenSteps), hn::Sub(y, row));
}

// What passes glass under layers that let the share `below` through, of what comes through them: what its
// interface reflects counts once, though F0 and F90 are covered by now.
HWY_INLINE void keep_passing(HitBatch& hits, int slot, MF glass, VF uncovered, VF below) {
  const VF covered = hn::Max(interface_at(hits, slot, true).passes, set(1e-6f));
  const VF share = hn::IfThenElse(glass, hn::Div(uncovered, covered), set(1.0f));
  const VF transmission = load(&hits.transmission[slot]);
  hn::Store(hn::Mul(transmission, hn::Mul(below, share)), kF, &hits.transmission[slot]);
}

// Lays coat and sheen of hits [0, count) over their bases, once per batch, before any light: FurtherLobes::
// coat becomes the share of light that the coat sends to the viewer (KHR: coat x Fresnel of n.v), sheen is
// scaled to send back no more than came, and what lies below gets what each lets through. Sheen is taken off
// by the viewer's angle alone. Glass has its layers outside.
HWY_NOINLINE inline void cover_bases(HitBatch& hits, int count) {
  FurtherLobes& lobes = *hits.lobes;
  const VF one = set(1.0f);
  const auto weaken = [](Lane3& lanes, int slot, VF by)
                          HWY_ATTR { store3(scale(load3(lanes, slot), by), lanes, slot); };
  for (int slot = 0; slot < count; slot += kLanes) {
    const VF cosine = hn::Abs(dot(load3(lobes.coat_normal, slot), load3(hits.viewer, slot)));
    const VF k = hn::Sub(one, hn::Min(cosine, one)), k2 = hn::Mul(k, k);
    const VF fresnel = hn::MulAdd(hn::Mul(hn::Mul(k2, k2), k), set(1.0f - kCoatF0), set(kCoatF0));
    const MF glass = hn::Gt(load(&hits.transmission[slot]), hn::Zero(kF));
    const MF within = hn::And(glass, hn::Gt(load(&hits.index_ratio[slot]), one));
    const VF uncovered = hn::AllFalse(kF, glass) ? one : interface_at(hits, slot, true).passes;
    const VF coat = hn::IfThenZeroElse(within, hn::Mul(load(&lobes.coat[slot]), fresnel));
    const VF past_coat = hn::Sub(one, coat);
    hn::Store(coat, kF, &lobes.coat[slot]);
    const VF share = sheen_share(hits, slot);
    const V3 sheen = only(hn::Not(within), load3(lobes.sheen, slot));
    store3(sheen, lobes.sheen, slot);
    const VF strongest = hn::Max(sheen.x, hn::Max(sheen.y, sheen.z));
    const VF past_sheen = hn::NegMulAdd(strongest, hn::Min(share, one), one);
    weaken(lobes.sheen, slot, hn::Div(past_coat, hn::Max(share, one)));
    weaken(hits.emission, slot, past_coat);
    const VF below = hn::Mul(past_coat, past_sheen);
    weaken(hits.diffuse, slot, below);
    weaken(hits.f0, slot, below);
    if (hits.gloss) weaken(hits.gloss->albedo, slot, below);
    hn::Store(hn::Mul(load(&hits.f90[slot]), below), kF, &hits.f90[slot]);
    if (!hn::AllFalse(kF, glass)) keep_passing(hits, slot, glass, uncovered, below);
  }
}

// What one sample of a light stands for in a highlight: by how much half vectors turn across it, squared, and
// which share of the highlight it brings (the rest comes by directions drawn from the lobe).
struct HighlightPart {
  VF turn2, share;
};
struct HighlightParts {
  HighlightPart base, coat;
};
HWY_INLINE HighlightParts whole_highlights(VF turn2) {
  const HighlightPart whole{turn2, set(1.0f)};
  return {whole, whole};
}

// The coat's highlight; `base`: the light's direction as the base needs it.
HWY_INLINE VF coat_lit(const HitBatch& hits, int slot, const LobeAngles& base, const V3& light, VF turn2) {
  const FurtherLobes& lobes = *hits.lobes;
  const V3 coat_n = load3(lobes.coat_normal, slot), v = load3(hits.viewer, slot);
  LobeAngles coat = base;
  coat.n_l = hn::Max(dot(coat_n, light), hn::Zero(kF));
  coat.n_v = hn::Max(hn::Abs(dot(coat_n, v)), set(1e-4f));
  coat.n_h = hn::Max(dot(coat_n, base.h), hn::Zero(kF));
  const VF alpha2 = load(&lobes.coat_alpha2[slot]);
  const VF wide2 = widened(hits, slot, alpha2, base.l_h, turn2);
  // Irradiance is that of the base's normal: the coat has its own.
  const VF turned = hn::Div(coat.n_l, hn::Max(base.n_l, set(1e-6f)));
  return hn::Mul(hn::Mul(load(&lobes.coat[slot]), turned), ggx(coat, coat_n, alpha2, wide2));
}

// Coat and sheen under direct light; the base is there already.
HWY_INLINE V3 layers_lit(const HitBatch& hits, int slot, const LobeAngles& base, const V3& n, const V3& light,
                         const HighlightPart& coat) {
  const FurtherLobes& lobes = *hits.lobes;
  const VF shine = hn::Mul(coat_lit(hits, slot, base, light, coat.turn2), coat.share);
  const V3 sheen = load3(lobes.sheen, slot);
  V3 f{shine, shine, shine};
  const MF fibres = hn::Gt(hn::Max(sheen.x, hn::Max(sheen.y, sheen.z)), hn::Zero(kF));
  if (!hn::AllFalse(kF, fibres)) {
    f = mul_add(hn::IfThenElseZero(fibres, charlie(hits, slot, base, n)), sheen, f);
  }
  return f;
}

// Share of light from all sides that coat and sheen send to the viewer: no mirror ray stands for any of it.
HWY_INLINE V3 layers_share(const HitBatch& hits, int slot) {
  const VF coat = load(&hits.lobes->coat[slot]);
  return mul_add(sheen_share(hits, slot), load3(hits.lobes->sheen, slot), {coat, coat, coat});
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
