// Bilinear fetches: of the camera's image for whoever shows it, and of radiance buffers. Texels are 4 halfs,
// so two neighbours are one 128-bit load and one widening conversion.
#pragma once

#include "renderer/simd/simd_types-inl.h"
#include "sessions/camera/camera_image.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

using F4 = hn::FixedTag<float, 4>;
using V4 = hn::Vec<F4>;
constexpr F4 kF4{};

// Bilinear blend of texels at p, p + 1 and one row below. Equal texels give exactly their value.
HWY_INLINE V4 bilinear(const std::uint16_t* p, std::size_t row_stride, float x, float y) {
  const auto* upper = reinterpret_cast<const hwy::float16_t*>(p);
  const auto* lower = reinterpret_cast<const hwy::float16_t*>(p + 4 * row_stride);
#if HWY_TARGET == HWY_SSE4
  const hn::FixedTag<hwy::float16_t, 4> half;
  const V4 wy = hn::Set(kF4, y);
  const auto column = [&](std::size_t i) HWY_ATTR {
    const V4 a = hn::PromoteTo(kF4, hn::LoadU(half, upper + i)),
             b = hn::PromoteTo(kF4, hn::LoadU(half, lower + i));
    return hn::MulAdd(wy, hn::Sub(b, a), a);
  };
  const V4 left = column(0), right = column(4);
#else
  const hn::FixedTag<float, 8> f8;
  const hn::FixedTag<hwy::float16_t, 8> half;
  const auto a = hn::PromoteTo(f8, hn::LoadU(half, upper)), b = hn::PromoteTo(f8, hn::LoadU(half, lower));
  const auto columns = hn::MulAdd(hn::Set(f8, y), hn::Sub(b, a), a);
  const V4 left = hn::LowerHalf(columns), right = hn::UpperHalf(kF4, columns);
#endif
  return hn::MulAdd(hn::Set(kF4, x), hn::Sub(right, left), left);
}

// Where camera pixels are fetched from.
struct FeedPlace {
  VI offset;    // texels, of the upper left of the four around the pixel
  VF x, y;      // weights of right and lower neighbours, [0, 1]
  MF in_image;  // pixels (0, 0) ... are centres: the image reaches half a pixel beyond them
};

// Camera pixel coordinates -> texel offset and weights, clamped to the image.
HWY_INLINE FeedPlace place_in_feed(const CameraImage& image, VF x, VF y) {
  const VF zero = hn::Zero(kF), half = set(0.5f), one = set(1.0f);
  const VF right = set(static_cast<float>(image.width_px - 1)),
           bottom = set(static_cast<float>(image.height_px - 1));
  FeedPlace at;
  at.in_image = hn::And(hn::And(hn::Ge(x, hn::Neg(half)), hn::Le(x, hn::Add(right, half))),
                        hn::And(hn::Ge(y, hn::Neg(half)), hn::Le(y, hn::Add(bottom, half))));
  const VF cx = hn::Min(hn::Max(x, zero), right), cy = hn::Min(hn::Max(y, zero), bottom);
  const VF x0 = hn::Min(hn::Floor(cx), hn::Sub(right, one)),
           y0 = hn::Min(hn::Floor(cy), hn::Sub(bottom, one));
  at.x = hn::Sub(cx, x0);
  at.y = hn::Sub(cy, y0);
  at.offset = hn::Add(hn::Mul(hn::ConvertTo(kI, y0), hn::Set(kI, image.width_px)), hn::ConvertTo(kI, x0));
  return at;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
