// Stage: finished viewports -> what an eye sees, a strip of rows a job. A row of each layer is summed over
// its source rows, then each pixel over its source columns, and laid over the layers below by its weight.
// Compiled once for each instruction set (simd/kernel_instance.cpp.in).
#pragma once

#include "renderer/simd/simd_types-inl.h"
#include "renderer/viewports/blended_view.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

using B4 = hn::FixedTag<float, 4>;
using VB4 = hn::Vec<B4>;

// Source rows `first` ... weighted, texels [begin, end), into floats at their own places.
HWY_INLINE void sum_rows(const ViewportImage& image, int first, int count, const float* weights, int begin,
                         int end, float* sums) {
  const hn::Rebind<hwy::float16_t, F> half;
  for (int i = begin / 4 * 16; i < 4 * end; i += kLanes) {  // whole vectors: rows are padded to 16 texels
    const auto value = [&](int row) HWY_ATTR {
      return hn::PromoteTo(kF, hn::LoadU(half, reinterpret_cast<const hwy::float16_t*>(image.row(row)) + i));
    };
    VF sum = hn::Mul(set(weights[0]), value(first));
    for (int k = 1; k < count; ++k) sum = hn::MulAdd(set(weights[k]), value(first + k), sum);
    hn::StoreU(sum, kF, sums + i);
  }
}

HWY_INLINE VB4 sum_columns(const float* sums, int first, int count, const float* weights) {
  const B4 d;
  const float* p = sums + 4 * static_cast<std::size_t>(first);
  VB4 sum = hn::Mul(hn::Set(d, weights[0]), hn::LoadU(d, p));
  for (int k = 1; k < count; ++k) sum = hn::MulAdd(hn::Set(d, weights[k]), hn::LoadU(d, p + 4 * k), sum);
  return sum;
}

HWY_INLINE float blend_weight(float t) {
  return t * t * (3.0f - 2.0f * t);
}

// Row y of the view, of one layer, over what `row` holds.
HWY_INLINE void lay_over(const BlendLayer& layer, const ViewportImage& image, int y, float* source,
                         float* row) {
  const BlendAxis &across = layer.x, &down = layer.y;
  if (y < down.begin || y >= down.end || across.begin == across.end) return;
  const auto j = static_cast<std::size_t>(y - down.begin);
  const float down_inside = down.inside[j];
  if (!(down_inside > 0)) return;
  sum_rows(image, down.first[j], down.count[j], &down.weights[j * down.most], across.first.front(),
           across.first.back() + across.count.back(), source);
  const B4 d;
  for (int x = across.begin; x < across.end; ++x) {
    const auto i = static_cast<std::size_t>(x - across.begin);
    const float inside = across.inside[i] < down_inside ? across.inside[i] : down_inside;
    if (!(inside > 0)) continue;
    const VB4 over = sum_columns(source, across.first[i], across.count[i], &across.weights[i * across.most]);
    float* pixel = row + 4 * static_cast<std::size_t>(x);
    // With the full weight nothing of what lies below is left, whatever it is.
    if (inside >= 1) {
      hn::StoreU(over, d, pixel);
      continue;
    }
    const VB4 below = hn::LoadU(d, pixel);
    hn::StoreU(hn::MulAdd(hn::Set(d, blend_weight(inside)), hn::Sub(over, below), below), d, pixel);
  }
}

HWY_INLINE void store_row(const float* row, int width_px, std::uint16_t* out) {
  const hn::Rebind<hwy::float16_t, F> half;
  const VF largest = set(kLargestHalf);
  for (int i = 0; i < 4 * width_px; i += kLanes) {
    const VF value = hn::Min(loadu(row + i), largest);
    hn::StoreU(hn::DemoteTo(half, half_rounded(kF, value)), half, reinterpret_cast<hwy::float16_t*>(out) + i);
  }
}

void blend_strip(const BlendJob& job, int strip, BlendScratch& scratch) {
  const PictureOutline& outline = job.view->outline;
  const int top = strip * kBlendedStripRows;
  const int bottom =
      top + kBlendedStripRows < outline.height_px ? top + kBlendedStripRows : outline.height_px;
  const std::size_t floats = 4 * static_cast<std::size_t>(outline.width_px);
  for (int y = top; y < bottom; ++y) {
    for (std::size_t i = 0; i < floats; ++i) scratch.row[i] = 0;
    for (const BlendLayer& layer : job.view->layers) {
      lay_over(layer, job.viewports[layer.viewport], y, scratch.source.data(), scratch.row.data());
    }
    store_row(scratch.row.data(), outline.width_px, job.out->row(y));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
