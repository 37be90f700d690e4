// Where the 16 pixels of a block row fetch from: coordinates -> texel offsets and weights, and the exact
// coordinates of pixels that no cell can interpolate.
#pragma once

#include "renderer/viewports/blend_pixels-inl.h"
#include "renderer/viewports/polar_coordinates-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

HWY_INLINE VF lane_x(int x, int lane) {
  return hn::ConvertTo(kF, hn::Add(hn::Iota(kI, 0), hn::Set(kI, x + lane)));
}

// Columns and rows of the sample to the upper left -> texel offsets.
HWY_INLINE void store_offsets(const ViewportJob& job, VF column, VF row, int lane, BlockCoordinates& out) {
  const std::size_t stride = job.radiance->row_stride();
  const VI per_row = hn::Set(kI, static_cast<std::int32_t>(stride)),
           first = hn::Set(kI, static_cast<std::int32_t>(texel_index(stride, 0, 0)));
  const VI offset =
      hn::Add(hn::Mul(hn::ConvertTo(kI, row), per_row), hn::Add(hn::ConvertTo(kI, column), first));
  hn::Store(hn::BitCast(kU, offset), kU, &out.offset[lane]);
}

// Polar coordinates (columns and rows of samples) -> texel offset and weights. Rows wrap;
// the border holds the rest.
HWY_INLINE void place_polar(const ViewportJob& job, VF column, VF row, int lane, BlockCoordinates& out) {
  const VF last = set(static_cast<float>(job.polar_width) - 0.5f),
           height = set(static_cast<float>(job.polar_height));
  const VF c = hn::Min(hn::Max(column, set(-0.5f)), last);
  VF r = hn::IfThenElse(hn::Lt(row, hn::Zero(kF)), hn::Add(row, height), row);
  r = hn::IfThenElse(hn::Ge(r, height), hn::Sub(r, height), r);
  const VF c0 = hn::Floor(c), r0 = hn::Min(hn::Floor(r), hn::Sub(height, set(1.0f)));
  hn::Store(hn::Sub(c, c0), kF, &out.x[lane]);
  hn::Store(hn::Sub(r, r0), kF, &out.y[lane]);
  store_offsets(job, c0, r0, lane, out);
}

// Camera pixel coordinates -> texel offset and weights, clamped to the image; outside it nothing is seen.
HWY_INLINE void place_feed(const ViewportJob& job, VF x, VF y, VF valid, int lane, FeedCoordinates& out) {
  const FeedPlace at = place_in_feed(*job.feed.image, x, y);
  hn::Store(hn::IfThenElseZero(at.in_image, valid), kF, &out.seen[lane]);
  hn::Store(at.x, kF, &out.at.x[lane]);
  hn::Store(at.y, kF, &out.at.y[lane]);
  hn::Store(hn::BitCast(kU, at.offset), kU, &out.at.offset[lane]);
}

// Feed coordinates of 16 pixels without interpolation.
inline void project_feed_exactly(const ViewportJob& job, int x, int y, FeedCoordinates& out) {
  alignas(64) float cx[kBlockColumns], cy[kBlockColumns], valid[kBlockColumns];
  for (int i = 0; i < kBlockColumns; ++i) {
    const auto pixel = camera_pixel(*job.viewport, job.feed, x + i, y);
    valid[i] = pixel ? 1.0f : 0.0f;
    cx[i] = pixel ? static_cast<float>(pixel->x) : 0.0f;
    cy[i] = pixel ? static_cast<float>(pixel->y) : 0.0f;
  }
  for (int lane = 0; lane < kBlockColumns; lane += kLanes) {
    place_feed(job, load(&cx[lane]), load(&cy[lane]), load(&valid[lane]), lane, out);
  }
}

// Without foveation, one texel per pixel.
HWY_INLINE void place_planar(const ViewportJob& job, int x, int y, BlockCoordinates& out) {
  for (int i = 0; i < kBlockColumns; ++i) {
    const int column = x + i < job.viewport->width_px ? x + i : job.viewport->width_px - 1;
    out.offset[i] = static_cast<std::uint32_t>(texel_index(job.radiance->row_stride(), column, y));
    out.x[i] = out.y[i] = 0.0f;
  }
}

// Without foveation, fewer texels than pixels: centres of pixels among centres of texels, clamped to these.
// Out of line: it takes registers from the loops around it.
HWY_NOINLINE inline void place_scaled(const ViewportJob& job, int x, int y, BlockCoordinates& out) {
  const auto texels_at = [](VF pixel, int pixels, int texels) HWY_ATTR {
    const VF per_pixel = set(static_cast<float>(texels) / static_cast<float>(pixels)), half = set(0.5f);
    const VF at = hn::MulSub(hn::Add(pixel, half), per_pixel, half);
    return hn::Min(hn::Max(at, hn::Zero(kF)), set(static_cast<float>(texels - 1)));
  };
  const VF r = texels_at(set(static_cast<float>(y)), job.viewport->height_px, job.planar_height);
  const VF r0 = hn::Floor(r);
  for (int lane = 0; lane < kBlockColumns; lane += kLanes) {
    const VF c = texels_at(lane_x(x, lane), job.viewport->width_px, job.planar_width);
    const VF c0 = hn::Floor(c);
    hn::Store(hn::Sub(c, c0), kF, &out.x[lane]);
    hn::Store(hn::Sub(r, r0), kF, &out.y[lane]);
    store_offsets(job, c0, r0, lane, out);
  }
}

HWY_INLINE void place_polar_exactly(const ViewportJob& job, int x, int y, BlockCoordinates& out) {
  for (int lane = 0; lane < kBlockColumns; lane += kLanes) {
    const PolarCoordinates p = polar_coordinates(job, lane_x(x, lane), set(static_cast<float>(y)));
    place_polar(job, p.column, p.row, lane, out);
  }
}

HWY_INLINE BlendSources sources_of(const ViewportJob& job) {
  const bool feed = job.feed.image != nullptr;
  return {job.radiance->texels(),
          job.radiance->ratios(),
          job.radiance->row_stride(),
          feed ? job.feed.image->rgba_half.data() : nullptr,
          feed ? static_cast<std::size_t>(job.feed.image->width_px) : 0,
          job.feed.white,
          job.opaque};
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
