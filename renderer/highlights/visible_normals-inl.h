// Directions drawn from a GGX highlight, and how densely they lie. Before: highlight_width says how wide
// lobes are. After: lighting draws what the strata of a lamp miss. Sources: Heitz, "Sampling the GGX
// Distribution of Visible Normals" (2018); drawn by the spherical caps of Dupuy & Benyoub (2023).
#pragma once

#include "renderer/simd/simd_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// GGX as drawn from: across `n`, alpha_t along `t` and alpha_b along `b`; `v` is the viewer in that frame.
struct DrawnLobe {
  V3 t, b, n, v;
  VF alpha_t, alpha_b;
  VF stretched_v;  // length of (alpha_t v.x, alpha_b v.y, v.z)
};

// A unit vector across `n`, in the plane of `n` and `v`: patterns turn with what is seen, so that no place or
// turn of a scene changes them.
HWY_INLINE V3 across_towards(const V3& n, const V3& v, VF n_v) {
  V3 t = mul_add(hn::Neg(n_v), n, v);
  const MF head_on = hn::Lt(dot(t, t), set(1e-6f));
  if (!hn::AllFalse(kF, head_on)) {
    const VF zero = hn::Zero(kF), one = set(1.0f);
    const MF upright = hn::Gt(hn::Abs(n.y), set(0.8f));
    t = select(head_on, cross(n, select(upright, V3{one, zero, zero}, V3{zero, one, zero})), t);
  }
  return normalise(t);
}

// The lobe of normal `n`, seen from `v`, whose tangent and widths are set.
HWY_INLINE void set_up(DrawnLobe& lobe, const V3& n, const V3& v, VF n_v) {
  lobe.n = n;
  lobe.b = cross(n, lobe.t);
  lobe.v = {dot(lobe.t, v), dot(lobe.b, v), n_v};
  const V3 stretched{hn::Mul(lobe.alpha_t, lobe.v.x), hn::Mul(lobe.alpha_b, lobe.v.y), n_v};
  lobe.stretched_v = hn::Sqrt(dot(stretched, stretched));
}

// How densely directions of half vector `h` (unit) are drawn, per steradian of the direction: that of visible
// normals, G1 D l.h / n.v, over 4 l.h, and G1 = 2 n.v / (n.v + stretched_v).
HWY_INLINE VF density_of(const DrawnLobe& lobe, const V3& h) {
  const VF x = hn::Div(dot(lobe.t, h), lobe.alpha_t), y = hn::Div(dot(lobe.b, h), lobe.alpha_b);
  const VF z = dot(lobe.n, h);
  const VF spread = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
  const VF area = hn::Mul(hn::Mul(lobe.alpha_t, lobe.alpha_b), hn::Mul(spread, spread));
  const VF twice = hn::Mul(set(2.0f), hn::Add(lobe.v.z, lobe.stretched_v));
  return hn::Div(set(0.318309886f), hn::Mul(area, twice));  // 1 / pi
}

// The same of a lobe that is as wide along all directions.
HWY_INLINE VF density_of(VF alpha2, const V3& n, VF n_v, const V3& h) {
  const V3 c = cross(n, h);
  const VF n_h = dot(n, h), spread = hn::MulAdd(hn::Mul(alpha2, n_h), n_h, dot(c, c));
  const VF stretched_v = hn::Sqrt(hn::MulAdd(hn::Sub(set(1.0f), alpha2), hn::Mul(n_v, n_v), alpha2));
  const VF twice = hn::Mul(set(2.0f), hn::Add(n_v, stretched_v));
  return hn::Div(hn::Mul(alpha2, set(0.318309886f)), hn::Mul(twice, hn::Mul(spread, spread)));
}

struct DrawnDirection {
  V3 direction, h;  // unit
};

// The direction that belongs to the place (cosine, sine of an azimuth; u in [0, 1)) in the lobe, `v` towards
// the viewer.
HWY_INLINE DrawnDirection draw(const DrawnLobe& lobe, const V3& v, VF cosine, VF sine, VF u) {
  const VF one = set(1.0f), per_length = hn::Div(one, lobe.stretched_v);
  const V3 w =
      scale({hn::Mul(lobe.alpha_t, lobe.v.x), hn::Mul(lobe.alpha_b, lobe.v.y), lobe.v.z}, per_length);
  const VF above = hn::Mul(hn::Sub(one, u), hn::Add(one, w.z)), z = hn::Sub(above, w.z);
  const VF radius = hn::Sqrt(hn::Max(hn::NegMulAdd(z, z, one), hn::Zero(kF)));
  const V3 local = normalise({hn::Mul(lobe.alpha_t, hn::MulAdd(radius, cosine, w.x)),
                              hn::Mul(lobe.alpha_b, hn::MulAdd(radius, sine, w.y)), above});
  DrawnDirection out;
  out.h = mul_add(local.x, lobe.t, mul_add(local.y, lobe.b, scale(lobe.n, local.z)));
  const VF twice = hn::Mul(set(2.0f), dot(v, out.h));
  out.direction = normalise(mul_add(twice, out.h, scale(v, set(-1.0f))));
  return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
