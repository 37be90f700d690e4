// Viewport pixels -> polar buffer coordinates, exact and vectorised: theta by atan2(|cross|, dot), u by
// log1p.
#pragma once

#include <hwy/contrib/math/math-inl.h>

#include "renderer/simd/vector_angles-inl.h"
#include "renderer/viewports/viewport_job.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

struct PolarCoordinates {
  VF column;  // u W - 1/2, in [-1/2, W - 1/2)
  VF row;     // v H - 1/2, in [-1/2, H - 1/2]
  VF theta_deg;
};

HWY_INLINE PolarCoordinates polar_coordinates(const ViewportJob& job, VF x, VF y) {
  const PixelToGaze& map = job.to_gaze;
  const auto component = [&](int i) HWY_ATTR {
    return hn::MulAdd(y, set(map.per_y[i]), hn::MulAdd(x, set(map.per_x[i]), set(map.base[i])));
  };
  const VF right = component(0), up = component(1), ahead = component(2);
  const VF off_axis = hn::Sqrt(hn::MulAdd(right, right, hn::Mul(up, up)));
  const VF theta = hn::Mul(atan2(off_axis, ahead), set(static_cast<float>(kDegreesPerRadian)));
  const VF half = set(0.5f);
  const VF column = hn::MulSub(hn::Log1p(kF, theta), set(job.theta_to_column), half);
  const VF turns = hn::Mul(atan2(up, right), set(0.159154943f));
  const VF v = hn::IfThenElse(hn::Lt(turns, hn::Zero(kF)), hn::Add(turns, set(1.0f)), turns);
  return {column, hn::MulSub(v, set(static_cast<float>(job.polar_height)), half), theta};
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
