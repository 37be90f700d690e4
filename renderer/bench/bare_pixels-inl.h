// The pixels of a frame with their coordinates computed beforehand. Compiled once for each
// instruction set (simd/kernel_instance.cpp.in).
#pragma once

#include <cstring>

#include "renderer/bench/bare_pixels.h"
#include "renderer/viewports/block_coordinates-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

void precompute_pixels(const ViewportJob& job, int x, int y, PrecomputedPixels& out) {
  BlockCoordinates polar;
  FeedCoordinates camera;
  if (job.polar) {
    place_polar_exactly(job, x, y, polar);
  } else if (job.one_texel_per_pixel()) {
    place_planar(job, x, y, polar);
  } else {
    place_scaled(job, x, y, polar);
  }
  if (job.feed.image) project_feed_exactly(job, x, y, camera);
  for (int i = 0; i < kBlockColumns; ++i) {
    out.polar_offset.push_back(polar.offset[i]);
    out.polar_x.push_back(polar.x[i]);
    out.polar_y.push_back(polar.y[i]);
    if (!job.feed.image) continue;
    out.camera_offset.push_back(camera.at.offset[i]);
    out.camera_x.push_back(camera.at.x[i]);
    out.camera_y.push_back(camera.at.y[i]);
  }
}

template <ResampleFilter kFilter, bool kFeed, bool kColoured>
void composite_precomputed_with(const ViewportJob& job, PrecomputedPixels& pixels, std::size_t first,
                                std::size_t count) {
  const BlendSources sources = sources_of(job);
  BlockCoordinates polar;
  FeedCoordinates camera;
  for (float& seen : camera.seen) seen = 1.0f;
  for (std::size_t block = first; block + kBlockColumns <= first + count; block += kBlockColumns) {
    std::memcpy(polar.offset, &pixels.polar_offset[block], sizeof(polar.offset));
    std::memcpy(polar.x, &pixels.polar_x[block], sizeof(polar.x));
    std::memcpy(polar.y, &pixels.polar_y[block], sizeof(polar.y));
    if constexpr (kFeed) {
      std::memcpy(camera.at.offset, &pixels.camera_offset[block], sizeof(camera.at.offset));
      std::memcpy(camera.at.x, &pixels.camera_x[block], sizeof(camera.at.x));
      std::memcpy(camera.at.y, &pixels.camera_y[block], sizeof(camera.at.y));
    }
    blend_block<kFilter, kFeed, kColoured>(sources, polar, camera, &pixels.out[4 * block]);
  }
}

template <ResampleFilter kFilter>
void composite_precomputed_by(const ViewportJob& job, PrecomputedPixels& pixels, std::size_t first,
                              std::size_t count) {
  const bool coloured = job.radiance->ratios() != nullptr;
  if (job.feed.image) {
    return coloured ? composite_precomputed_with<kFilter, true, true>(job, pixels, first, count)
                    : composite_precomputed_with<kFilter, true, false>(job, pixels, first, count);
  }
  composite_precomputed_with<kFilter, false, false>(job, pixels, first, count);
}

void composite_precomputed(const ViewportJob& job, PrecomputedPixels& pixels, std::size_t first,
                           std::size_t count) {
  switch (job.filter) {
    case ResampleFilter::nearest:
      return composite_precomputed_by<ResampleFilter::nearest>(job, pixels, first, count);
    case ResampleFilter::bilinear:
      return composite_precomputed_by<ResampleFilter::bilinear>(job, pixels, first, count);
    case ResampleFilter::bicubic:
      return composite_precomputed_by<ResampleFilter::bicubic>(job, pixels, first, count);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
