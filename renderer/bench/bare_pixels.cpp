// The pixels of a frame with their coordinates computed beforehand. Compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/bench/bare_pixels.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include <cstring>

#include "renderer/bench/bare_pixels.h"
#include "renderer/simd/simd_dispatch.h"
#include "renderer/viewports/block_coordinates-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

void PrecomputePixelsKernel(const ViewportJob& job, int x, int y, PrecomputedPixels& out) {
  BlockCoordinates polar;
  FeedCoordinates camera;
  if (job.polar) {
    place_polar_exactly(job, x, y, polar);
  } else {
    place_planar(job, x, y, polar);
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

template <bool kFeed, bool kColoured>
void composite_precomputed(const ViewportJob& job, PrecomputedPixels& pixels, std::size_t first,
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
    blend_block<kFeed, kColoured>(sources, polar, camera, &pixels.out[4 * block]);
  }
}

void CompositePrecomputedKernel(const ViewportJob& job, PrecomputedPixels& pixels, std::size_t first,
                                std::size_t count) {
  const bool coloured = job.radiance->ratios() != nullptr;
  if (job.feed.image) {
    return coloured ? composite_precomputed<true, true>(job, pixels, first, count)
                    : composite_precomputed<true, false>(job, pixels, first, count);
  }
  composite_precomputed<false, false>(job, pixels, first, count);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace herr {

HWY_EXPORT(PrecomputePixelsKernel);
HWY_EXPORT(CompositePrecomputedKernel);

PrecomputePixels precompute_pixels_for(Isa isa) {
  return kernel_for(isa, [] { return &HWY_DYNAMIC_DISPATCH(PrecomputePixelsKernel); });
}
CompositePrecomputed composite_precomputed_for(Isa isa) {
  return kernel_for(isa, [] { return &HWY_DYNAMIC_DISPATCH(CompositePrecomputedKernel); });
}

}  // namespace herr
#endif
