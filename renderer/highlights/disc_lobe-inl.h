// GGX of light from an even disc, in closed form. Before: bright sources of an environment picture. After:
// reflectance/gloss-inl.h.
// GGX over the plane of half vectors, alpha^2 / pi (r^2 + alpha^2)^2, is the form factor per area between two
// parallel patches alpha apart; its mean over a disc is that of a parallel disc, over its area. Source:
// Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-12.
#pragma once

#include "renderer/simd/simd_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Mean of alpha2 / pi (r^2 + alpha2)^2 over places within sqrt(rim2) of one that lies sqrt(off2) off the
// middle; alpha2: above 0. With x = off2 + alpha2 - rim2 and s^2 = x^2 + 4 alpha2
// rim2 it is (s - x) / 2 pi rim2 s, or 2 alpha2 / pi s (s + x): whichever cancels nothing.
HWY_INLINE VF ggx_over_disc(VF off2, VF alpha2, VF rim2) {
  const VF zero = hn::Zero(kF), x = hn::Sub(hn::Add(off2, alpha2), rim2);
  const VF s = hn::Sqrt(hn::MulAdd(x, x, hn::Mul(set(4.0f), hn::Mul(alpha2, rim2))));
  const MF outside = hn::Gt(x, zero);
  const VF above = hn::IfThenElse(outside, hn::Add(alpha2, alpha2), hn::Sub(s, x));
  const VF below = hn::IfThenElse(outside, hn::Add(s, x), hn::Add(rim2, rim2));
  return hn::Div(hn::Mul(above, set(0.318309886f)), hn::Max(hn::Mul(s, below), set(1e-16f)));  // 1 / pi
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
