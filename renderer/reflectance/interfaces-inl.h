// What light does at a surface that it meets: directions in which it is mirrored and refracted, and the
// shares that go there. Before: surfaces. After: reflections and onward_rays send rays.
// Glass: Snell's law and Fresnel's equations for unpolarised light (Born & Wolf, Principles of Optics, 1.5);
// opaque mirrors: Schlick's approximation.
#pragma once

#include "renderer/tiles/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// (1 - cosine)^5, for Schlick's approximation of Fresnel's reflectance.
HWY_INLINE VF schlick_weight(VF cosine) {
  const VF one = set(1.0f);
  const VF k = hn::Sub(one, hn::Min(hn::Max(cosine, hn::Zero(kF)), one));
  const VF k2 = hn::Mul(k, k);
  return hn::Mul(hn::Mul(k2, k2), k);
}

HWY_INLINE VF largest(const V3& v) {
  return hn::Max(v.x, hn::Max(v.y, v.z));
}
HWY_INLINE V3 add(const V3& a, const V3& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE V3 multiply(const V3& a, const V3& b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}
HWY_INLINE V3 mul_add(const V3& a, const V3& b, const V3& c) {
  return {hn::MulAdd(a.x, b.x, c.x), hn::MulAdd(a.y, b.y, c.y), hn::MulAdd(a.z, b.z, c.z)};
}
HWY_INLINE V3 only(MF lanes, const V3& v) {
  return {hn::IfThenElseZero(lanes, v.x), hn::IfThenElseZero(lanes, v.y), hn::IfThenElseZero(lanes, v.z)};
}

// Direction mirrored at the normal; `v` is towards the viewer. An interpolated normal can send the ray into
// the surface; the triangle's own normal never does.
HWY_INLINE V3 mirrored(const V3& v, const V3& n, const V3& g) {
  const auto reflect = [&](const V3& normal) HWY_ATTR {
    return mul_add(hn::Mul(set(2.0f), dot(normal, v)), normal, scale(v, set(-1.0f)));
  };
  const V3 bent = reflect(n);
  return select(hn::Gt(dot(bent, g), hn::Zero(kF)), bent, reflect(g));
}

// Share of the mirror ray that is seen, per channel: mirror * (F0 + (F90 - F0) (1 - n.v)^5), or of surfaces
// that reflect by their roughness mirror * what their lobe reflects. F90 is 1 unless highlights are weighted.
HWY_INLINE V3 mirror_weight(const FramePlan& plan, const HitBatch& hits, int slot, VF cosine) {
  const VF one = set(1.0f), grazing = schlick_weight(cosine), mirror = load(&hits.mirror[slot]);
  const VF f90 = plan.surface_details ? load(&hits.f90[slot]) : one;
  const V3 f0 = load3(hits.f0, slot);
  V3 reflects = mul_add(grazing, sub({f90, f90, f90}, f0), f0);
  if (plan.gloss) {
    const MF own = hn::Gt(load(&hits.gloss->own[slot]), hn::Zero(kF));
    reflects = select(own, load3(hits.gloss->albedo, slot), reflects);
  }
  return scale(reflects, mirror);
}

// Fresnel's reflectance of an interface between dielectrics: `eta` is the index of the viewer's side over
// that of the other, the cosines are those on either side.
HWY_INLINE VF fresnel(VF eta, VF cosine, VF below) {
  const VF tiny = set(1e-20f);
  const VF s = hn::Div(hn::MulSub(eta, cosine, below), hn::Max(hn::MulAdd(eta, cosine, below), tiny));
  const VF p = hn::Div(hn::NegMulAdd(eta, below, cosine), hn::Max(hn::MulAdd(eta, below, cosine), tiny));
  return hn::Mul(set(0.5f), hn::MulAdd(s, s, hn::Mul(p, p)));
}

struct Interface {
  V3 through, back;  // directions of the refracted and the mirrored ray
  V3 reflects;       // share of the light that is mirrored, per channel
  VF passes;         // share that is refracted; 0 where reflection is total
  MF total, inside;  // total reflection; the viewer is inside the body
};

// Of transparent hits. Fresnel's curve runs from the material's own F0 to its F90, so that what weighs
// highlights weighs the reflection too: of a plain dielectric it is Fresnel's reflectance itself.
HWY_INLINE Interface interface_at(const HitBatch& hits, int slot, bool weighted) {
  const VF one = set(1.0f), zero = hn::Zero(kF), eta = load(&hits.index_ratio[slot]);
  const V3 v = load3(hits.viewer, slot), n = load3(hits.normal, slot);
  const V3 g = load3(hits.geometric_normal, slot);
  const VF normal_f0 = load(&hits.dielectric_f0[slot]);
  const VF cosine = hn::Min(hn::Max(dot(n, v), zero), one);
  // Squared cosine on the other side, 1 - eta^2 (1 - cos^2).
  const VF eta2 = hn::Mul(eta, eta);
  const VF below2 = hn::MulAdd(hn::Mul(eta2, cosine), cosine, hn::Sub(one, eta2));
  const VF below = hn::Sqrt(hn::Max(below2, zero));
  const MF no_step = hn::And(hn::Lt(hn::Abs(hn::Sub(eta, one)), set(1e-6f)), hn::Lt(normal_f0, set(0.5f)));
  const MF no_way = hn::Ge(normal_f0, one);  // index 0: reflects all
  Interface out;
  out.inside = hn::Gt(eta, one);
  out.total = hn::Or(no_way, hn::AndNot(no_step, hn::Le(below2, zero)));
  // eta (-v) + (eta cos - cos') n
  const V3 ahead = scale(v, set(-1.0f));
  const V3 bent = normalise(mul_add(hn::MulSub(eta, cosine, below), n, scale(v, hn::Neg(eta))));
  // An interpolated normal can leave the ray on the viewer's side: it then goes straight on.
  out.through = select(hn::AndNot(no_step, hn::Lt(dot(bent, g), zero)), bent, ahead);
  out.back = mirrored(v, n, g);
  VF bare = hn::IfThenZeroElse(no_step, fresnel(eta, cosine, below));
  bare = hn::IfThenElse(out.total, one, bare);
  const VF curve = hn::IfThenElse(
      out.total, one, hn::Div(hn::Sub(bare, normal_f0), hn::Max(hn::Sub(one, normal_f0), set(1e-6f))));
  const VF f90 = weighted ? load(&hits.f90[slot]) : one;
  const V3 f0 = load3(hits.f0, slot);
  const V3 own = mul_add(curve, sub({f90, f90, f90}, f0), f0);
  const auto bounded = [&](VF x) HWY_ATTR {
    return hn::IfThenElse(out.total, one, hn::Min(hn::Max(x, zero), one));
  };
  out.reflects = {bounded(own.x), bounded(own.y), bounded(own.z)};
  // Metal in the mixture reflects more, but passes nothing by `transmission` already.
  out.passes = hn::Sub(one, hn::Min(largest(out.reflects), bare));
  return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
