// Fetch, blend and store of a block row of 16 pixels: texels of the radiance buffer by one of three filters,
// four of the camera feed, out = feed * r + s. Texels are 4 halfs, so two neighbours are one 128-bit load and
// one widening conversion.
#pragma once

#include "renderer/feed/feed_texels-inl.h"
#include "renderer/viewports/viewport_job.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Where the 16 pixels of a block row fetch from.
struct alignas(64) BlockCoordinates {
  std::uint32_t offset[kBlockColumns];       // texels, of the upper left of the four around the pixel
  float x[kBlockColumns], y[kBlockColumns];  // weights of right and lower neighbours, [0, 1]
};
struct alignas(64) FeedCoordinates {
  BlockCoordinates at;
  float seen[kBlockColumns];  // 1 inside the image, 0 outside
};

HWY_INLINE V4 nearest(const std::uint16_t* p, std::size_t row_stride, float x, float y) {
  const hn::FixedTag<hwy::float16_t, 4> half;
  const std::size_t right = x >= 0.5f ? 4 : 0, down = y >= 0.5f ? 4 * row_stride : 0;
  return hn::PromoteTo(kF4, hn::LoadU(half, reinterpret_cast<const hwy::float16_t*>(p + right + down)));
}

// Catmull-Rom weights of a block row's pixels along one axis, for the texels before, after and beyond the one
// after; the rest of 1 is the weight of the texel that the pixel follows.
struct alignas(64) CubicWeights {
  float before[kBlockColumns], after[kBlockColumns], beyond[kBlockColumns];
};

HWY_INLINE void set_cubic(const float (&at)[kBlockColumns], CubicWeights& out) {
  for (int lane = 0; lane < kBlockColumns; lane += kLanes) {
    const VF t = load(&at[lane]), left = hn::Sub(set(1.0f), t);
    const VF outside = hn::Mul(set(-0.5f), hn::Mul(t, left));
    hn::Store(hn::Mul(outside, left), kF, &out.before[lane]);
    hn::Store(hn::Mul(t, hn::MulAdd(t, hn::NegMulAdd(set(1.5f), t, set(2.0f)), set(0.5f))), kF,
              &out.after[lane]);
    hn::Store(hn::Mul(outside, t), kF, &out.beyond[lane]);
  }
}

// Differences to the texel itself are blended: equal texels give exactly their value.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V blend_cubic(D d, const CubicWeights& weights, int i, V before, V at, V after, V beyond) {
  const V sum = hn::MulAdd(hn::Set(d, weights.before[i]), hn::Sub(before, at), at);
  return hn::MulAdd(hn::Set(d, weights.beyond[i]), hn::Sub(beyond, at),
                    hn::MulAdd(hn::Set(d, weights.after[i]), hn::Sub(after, at), sum));
}

// Neighbouring columns at p, as many as fit in D, blended with those of the rows above and below.
template <class D>
HWY_INLINE hn::Vec<D> cubic_columns(D d, const std::uint16_t* p, std::size_t row_stride,
                                    const CubicWeights& down, int i) {
  const hn::Rebind<hwy::float16_t, D> half;
  const auto row = [&](const std::uint16_t* q) HWY_ATTR {
    return hn::PromoteTo(d, hn::LoadU(half, reinterpret_cast<const hwy::float16_t*>(q)));
  };
  const std::size_t step = 4 * row_stride;
  return blend_cubic(d, down, i, row(p - step), row(p), row(p + step), row(p + 2 * step));
}

// Bicubic blend of the 4 x 4 texels around p and p + 1, within [0, limit].
HWY_INLINE V4 bicubic(const std::uint16_t* p, std::size_t row_stride, const CubicWeights& across,
                      const CubicWeights& down, int i, V4 limit) {
#if HWY_TARGET == HWY_SSE4
  const V4 c0 = cubic_columns(kF4, p - 4, row_stride, down, i),
           c1 = cubic_columns(kF4, p, row_stride, down, i),
           c2 = cubic_columns(kF4, p + 4, row_stride, down, i),
           c3 = cubic_columns(kF4, p + 8, row_stride, down, i);
#else
  const hn::FixedTag<float, 8> f8;
#if HWY_TARGET == HWY_AVX2
  const auto left = cubic_columns(f8, p - 4, row_stride, down, i),
             right = cubic_columns(f8, p + 4, row_stride, down, i);
#else
  const hn::FixedTag<float, 16> f16;
  const auto all = cubic_columns(f16, p - 4, row_stride, down, i);
  const auto left = hn::LowerHalf(all), right = hn::UpperHalf(f8, all);
#endif
  const V4 c0 = hn::LowerHalf(left), c1 = hn::UpperHalf(kF4, left), c2 = hn::LowerHalf(right),
           c3 = hn::UpperHalf(kF4, right);
#endif
  return hn::Min(hn::Max(blend_cubic(kF4, across, i, c0, c1, c2, c3), hn::Zero(kF4)), limit);
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
  float feed_white;
  bool opaque;
};

// Of one block row, for the bicubic filter alone.
struct BlockWeights {
  CubicWeights across, down;
};

template <ResampleFilter kFilter>
HWY_INLINE V4 resample(const std::uint16_t* plane, std::size_t row_stride, const BlockCoordinates& at,
                       const BlockWeights& weights, int i, V4 limit) {
  const std::uint16_t* p = plane + 4 * static_cast<std::size_t>(at.offset[i]);
  if constexpr (kFilter == ResampleFilter::nearest) return nearest(p, row_stride, at.x[i], at.y[i]);
  if constexpr (kFilter == ResampleFilter::bilinear) return bilinear(p, row_stride, at.x[i], at.y[i]);
  if constexpr (kFilter == ResampleFilter::bicubic) {
    return bicubic(p, row_stride, weights.across, weights.down, i, limit);
  }
}

template <ResampleFilter kFilter, bool kFeed, bool kColoured>
HWY_INLINE V4 blend_pixel(const BlendSources& from, const BlockCoordinates& polar,
                          const BlockWeights& weights, const FeedCoordinates& camera, int i) {
  const V4 one = hn::Set(kF4, 1.0f), largest_ratio = hn::Set(kF4, kLargestRatio);
  const V4 s = resample<kFilter>(from.texels, from.texel_stride, polar, weights, i,
                                 with_alpha(hn::Set(kF4, kLargestHalf), largest_ratio));
  V4 ratio = hn::Broadcast<3>(s);
  if constexpr (kColoured) {
    ratio = resample<kFilter>(from.ratios, from.texel_stride, polar, weights, i, largest_ratio);
  }
  if constexpr (kFeed) {
    const V4 feed = bilinear(from.feed + 4 * static_cast<std::size_t>(camera.at.offset[i]), from.feed_stride,
                             camera.at.x[i], camera.at.y[i]);
    const V4 kept = hn::Mul(ratio, hn::Set(kF4, camera.seen[i] * from.feed_white));
    // Feed and texel are each within half's range, their sum need not be.
    return with_alpha(hn::Min(hn::MulAdd(feed, kept, s), hn::Set(kF4, kLargestHalf)), one);
  }
  return with_alpha(s, from.opaque ? one : hn::Sub(one, hn::Broadcast<3>(s)));
}

// 16 pixels to `out` (4 halfs each, 16-byte aligned).
template <ResampleFilter kFilter, bool kFeed, bool kColoured>
HWY_INLINE void blend_block(const BlendSources& from, const BlockCoordinates& polar,
                            const FeedCoordinates& camera, std::uint16_t* out) {
  BlockWeights weights;
  if constexpr (kFilter == ResampleFilter::bicubic) {
    set_cubic(polar.x, weights.across);
    set_cubic(polar.y, weights.down);
  }
  for (int i = 0; i < kBlockColumns; i += 2) {
    const V4 first = blend_pixel<kFilter, kFeed, kColoured>(from, polar, weights, camera, i);
    const V4 second = blend_pixel<kFilter, kFeed, kColoured>(from, polar, weights, camera, i + 1);
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
