// Angles of vectors, vectorised.
#pragma once

#include <hwy/contrib/math/math-inl.h>

#include "renderer/simd/simd_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Angle of (x, y) in (-pi, pi]; (0, 0) gives 0.
HWY_INLINE VF atan2(VF y, VF x) {
  constexpr float kHalfPi = 1.57079633f, kFullPi = 3.14159265f;
  const VF ax = hn::Abs(x), ay = hn::Abs(y);
  const VF ratio = hn::Div(hn::Min(ax, ay), hn::Max(hn::Max(ax, ay), set(1e-37f)));
  VF angle = hn::Atan(kF, ratio);
  angle = hn::IfThenElse(hn::Gt(ay, ax), hn::Sub(set(kHalfPi), angle), angle);
  angle = hn::IfThenElse(hn::Lt(x, hn::Zero(kF)), hn::Sub(set(kFullPi), angle), angle);
  return hn::CopySign(angle, y);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
