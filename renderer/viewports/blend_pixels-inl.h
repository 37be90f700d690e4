// Fetch, blend and store of a block row of 16 pixels: four texels of the radiance buffer, four of
// the camera feed, out = feed * r + s. Texels are 4 halfs, so two neighbours are one 128-bit load
// and one widening conversion.
#pragma once

#include "renderer/simd/simd_types-inl.h"
#include "renderer/viewports/viewport_job.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

using F4 = hn::FixedTag<float, 4>;
using V4 = hn::Vec<F4>;
constexpr F4 kF4{};

// Where the 16 pixels of a block row fetch from.
struct alignas(64) BlockCoordinates {
  std::uint32_t offset[kBlockColumns];       // texels, of the upper left of four
  float x[kBlockColumns], y[kBlockColumns];  // weights of right and lower neighbours, [0, 1]
};
struct alignas(64) FeedCoordinates {
  BlockCoordinates at;
  float seen[kBlockColumns];  // 1 inside the image, 0 outside
};

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

HWY_INLINE V4 with_alpha(V4 rgb, V4 alpha) {
  return hn::IfThenElse(hn::FirstN(kF4, 3), rgb, alpha);
}

struct BlendSources {
  const std::uint16_t* texels;
  const std::uint16_t* ratios;  // null unless the ratio has a colour
  std::size_t texel_stride;
  const std::uint16_t* feed;
  std::size_t feed_stride;
  bool opaque;
};

template <bool kFeed, bool kColoured>
HWY_INLINE V4 blend_pixel(const BlendSources& from, const BlockCoordinates& polar,
                          const FeedCoordinates& camera, int i) {
  const V4 one = hn::Set(kF4, 1.0f);
  const V4 s = bilinear(from.texels + 4 * static_cast<std::size_t>(polar.offset[i]), from.texel_stride,
                        polar.x[i], polar.y[i]);
  V4 ratio = hn::Broadcast<3>(s);
  if constexpr (kColoured) {
    ratio = bilinear(from.ratios + 4 * static_cast<std::size_t>(polar.offset[i]), from.texel_stride,
                     polar.x[i], polar.y[i]);
  }
  if constexpr (kFeed) {
    const V4 feed = bilinear(from.feed + 4 * static_cast<std::size_t>(camera.at.offset[i]), from.feed_stride,
                             camera.at.x[i], camera.at.y[i]);
    const V4 kept = hn::Mul(ratio, hn::Set(kF4, camera.seen[i]));
    // Feed and texel are each within half's range, their sum need not be.
    return with_alpha(hn::Min(hn::MulAdd(feed, kept, s), hn::Set(kF4, kLargestHalf)), one);
  }
  return with_alpha(s, from.opaque ? one : hn::Sub(one, hn::Broadcast<3>(s)));
}

// 16 pixels to `out` (4 halfs each, 16-byte aligned).
template <bool kFeed, bool kColoured>
HWY_INLINE void blend_block(const BlendSources& from, const BlockCoordinates& polar,
                            const FeedCoordinates& camera, std::uint16_t* out) {
  for (int i = 0; i < kBlockColumns; i += 2) {
    const V4 first = blend_pixel<kFeed, kColoured>(from, polar, camera, i);
    const V4 second = blend_pixel<kFeed, kColoured>(from, polar, camera, i + 1);
#if HWY_TARGET == HWY_SSE4
    const hn::FixedTag<hwy::float16_t, 4> half;
    hn::StoreU(hn::DemoteTo(half, half_rounded(kF4, first)), half,
               reinterpret_cast<hwy::float16_t*>(out) + 4 * i);
    hn::StoreU(hn::DemoteTo(half, half_rounded(kF4, second)), half,
               reinterpret_cast<hwy::float16_t*>(out) + 4 * i + 4);
#else
    const hn::FixedTag<float, 8> f8;
    const hn::FixedTag<hwy::float16_t, 8> half;
    hn::StoreU(hn::DemoteTo(half, hn::Combine(f8, second, first)), half,
               reinterpret_cast<hwy::float16_t*>(out) + 4 * i);
#endif
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
