// Stage: radiance buffer -> viewport pixels, composited over the re-projected camera feed, a strip of 16 rows
// a job. Compiled once per instruction set (Google Highway's foreach_target).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/viewports/composite_strip.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include <cstring>

#include "renderer/simd_dispatch.h"
#include "renderer/viewports/blend_pixels-inl.h"
#include "renderer/viewports/polar_coordinates-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Polar coordinates (columns and rows of samples) -> texel offset and weights. Rows wrap; the padding holds
// the rest.
HWY_INLINE void place_polar(const ViewportJob& job, VF column, VF row, int lane, BlockCoordinates& out) {
  const VF last = set(static_cast<float>(job.polar_width) - 0.5f),
           height = set(static_cast<float>(job.polar_height));
  const VF c = hn::Min(hn::Max(column, set(-0.5f)), last);
  VF r = hn::IfThenElse(hn::Lt(row, hn::Zero(kF)), hn::Add(row, height), row);
  r = hn::IfThenElse(hn::Ge(r, height), hn::Sub(r, height), r);
  const VF c0 = hn::Floor(c), r0 = hn::Min(hn::Floor(r), hn::Sub(height, set(1.0f)));
  hn::Store(hn::Sub(c, c0), kF, &out.x[lane]);
  hn::Store(hn::Sub(r, r0), kF, &out.y[lane]);
  const VI stride = hn::Set(kI, static_cast<std::int32_t>(job.radiance->row_stride()));
  const VI offset =
      hn::Add(hn::Mul(hn::ConvertTo(kI, r0), stride), hn::Add(hn::ConvertTo(kI, c0), hn::Set(kI, 1)));
  hn::Store(hn::BitCast(kU, offset), kU, &out.offset[lane]);
}

// Camera pixel coordinates -> texel offset and weights, clamped to the image; outside it nothing is seen.
HWY_INLINE void place_feed(const ViewportJob& job, VF x, VF y, VF valid, int lane, FeedCoordinates& out) {
  const CameraImage& image = *job.feed.image;
  const VF zero = hn::Zero(kF), half = set(0.5f), one = set(1.0f);
  const VF right = set(static_cast<float>(image.width_px - 1)),
           bottom = set(static_cast<float>(image.height_px - 1));
  const MF inside = hn::And(hn::And(hn::Ge(x, hn::Neg(half)), hn::Le(x, hn::Add(right, half))),
                            hn::And(hn::Ge(y, hn::Neg(half)), hn::Le(y, hn::Add(bottom, half))));
  hn::Store(hn::IfThenElseZero(inside, valid), kF, &out.seen[lane]);
  const VF cx = hn::Min(hn::Max(x, zero), right), cy = hn::Min(hn::Max(y, zero), bottom);
  const VF x0 = hn::Min(hn::Floor(cx), hn::Sub(right, one)),
           y0 = hn::Min(hn::Floor(cy), hn::Sub(bottom, one));
  hn::Store(hn::Sub(cx, x0), kF, &out.at.x[lane]);
  hn::Store(hn::Sub(cy, y0), kF, &out.at.y[lane]);
  const VI offset =
      hn::Add(hn::Mul(hn::ConvertTo(kI, y0), hn::Set(kI, image.width_px)), hn::ConvertTo(kI, x0));
  hn::Store(hn::BitCast(kU, offset), kU, &out.at.offset[lane]);
}

// Per-lane linear pieces of a bilinear cell: value at row t of the cell is at_top + t * per_row.
struct alignas(64) CellRows {
  float at_top[kBlockColumns], per_row[kBlockColumns];
  HWY_INLINE VF at(int lane, VF t) const { return hn::MulAdd(t, load(&per_row[lane]), load(&at_top[lane])); }
};

HWY_INLINE void set_cell(CellRows& rows, int first, int columns, float c00, float c10, float c01, float c11) {
  const float across = c10 - c00, down = c01 - c00, twist = (c11 - c01) - across;
  for (int i = 0; i < columns; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(columns);
    rows.at_top[first + i] = c00 + t * across;
    rows.per_row[first + i] = down + t * twist;
  }
}

HWY_INLINE VF lane_x(int x, int lane) {
  return hn::ConvertTo(kF, hn::Add(hn::Iota(kI, 0), hn::Set(kI, x + lane)));
}

// Polar coordinates of all cell corners of the strip's three corner rows.
HWY_INLINE void compute_polar_corners(const ViewportJob& job, int y0, StripScratch& scratch) {
  const int corners = job.viewport->width_px / kCellSide + 3;
  for (int r = 0; r < 3; ++r) {
    const VF y = set(static_cast<float>(y0 + r * kCellSide));
    const std::size_t base = static_cast<std::size_t>(r) * scratch.corner_stride;
    for (int c = 0; c < corners; c += kLanes) {
      const VF x = hn::Mul(lane_x(c, 0), set(static_cast<float>(kCellSide)));
      const PolarCoordinates p = polar_coordinates(job, x, y);
      const std::size_t at = base + static_cast<std::size_t>(c);
      hn::StoreU(p.column, kF, &scratch.u[at]);
      hn::StoreU(p.row, kF, &scratch.v[at]);
      hn::StoreU(p.theta_deg, kF, &scratch.theta[at]);
    }
  }
}

void compute_camera_corners(const ViewportJob& job, int y0, StripScratch& scratch) {
  const int corners = job.viewport->width_px / kBlockColumns + 2;
  for (int r = 0; r < 2; ++r) {
    for (int c = 0; c < corners; ++c) {
      const std::size_t at =
          static_cast<std::size_t>(r) * scratch.camera_stride + static_cast<std::size_t>(c);
      const auto pixel = camera_pixel(*job.viewport, job.feed, c * kBlockColumns, y0 + r * kStripRows);
      scratch.camera_valid[at] = pixel.has_value();
      scratch.camera_x[at] = pixel ? static_cast<float>(pixel->x) : 0.0f;
      scratch.camera_y[at] = pixel ? static_cast<float>(pixel->y) : 0.0f;
    }
  }
}

// Fills the block's two cells; false when a cell needs exact coordinates.
HWY_INLINE bool set_polar_cells(const ViewportJob& job, const StripScratch& scratch, int half_strip,
                                int block, CellRows& columns, CellRows& rows) {
  const auto height = static_cast<float>(job.polar_height);
  for (int cell = 0; cell < 2; ++cell) {
    const std::size_t a = static_cast<std::size_t>(half_strip) * scratch.corner_stride +
                          static_cast<std::size_t>(2 * block + cell);
    const std::size_t b = a + scratch.corner_stride;
    for (const std::size_t corner : {a, a + 1, b, b + 1}) {
      const float theta = scratch.theta[corner];
      if (!(theta > job.exact_below_deg) || !(theta < 180.0f - job.exact_below_deg)) return false;
    }
    set_cell(columns, cell * kCellSide, kCellSide, scratch.u[a], scratch.u[a + 1], scratch.u[b],
             scratch.u[b + 1]);
    // Across the seam the row coordinate jumps by the height: unwrap against the first corner.
    const float v00 = scratch.v[a];
    const auto unwrap = [&](float v) {
      return v - v00 > height / 2 ? v - height : v - v00 < -height / 2 ? v + height : v;
    };
    set_cell(rows, cell * kCellSide, kCellSide, v00, unwrap(scratch.v[a + 1]), unwrap(scratch.v[b]),
             unwrap(scratch.v[b + 1]));
  }
  return true;
}

HWY_INLINE bool set_camera_cell(const ViewportJob& job, const StripScratch& scratch, int block, CellRows& xs,
                                CellRows& ys) {
  const auto a = static_cast<std::size_t>(block), b = a + scratch.camera_stride;
  const auto& valid = scratch.camera_valid;
  if (!job.feed.interpolate || !valid[a] || !valid[a + 1] || !valid[b] || !valid[b + 1]) return false;
  const auto& x = scratch.camera_x;
  const auto& y = scratch.camera_y;
  set_cell(xs, 0, kBlockColumns, x[a], x[a + 1], x[b], x[b + 1]);
  set_cell(ys, 0, kBlockColumns, y[a], y[a + 1], y[b], y[b + 1]);
  return true;
}

// Feed coordinates of 16 pixels without interpolation.
void project_feed_exactly(const ViewportJob& job, int x, int y, FeedCoordinates& out) {
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

// Without foveation there is one texel per pixel.
HWY_INLINE void place_planar(const ViewportJob& job, int x, int y, BlockCoordinates& out) {
  for (int i = 0; i < kBlockColumns; ++i) {
    const int column = x + i < job.viewport->width_px ? x + i : job.viewport->width_px - 1;
    out.offset[i] = static_cast<std::uint32_t>(static_cast<std::size_t>(y) * job.radiance->row_stride() +
                                               static_cast<std::size_t>(column));
    out.x[i] = out.y[i] = 0.0f;
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
          job.opaque};
}

template <bool kFeed, bool kColoured>
void composite_strip(const ViewportJob& job, int strip, StripScratch& scratch) {
  const int y0 = strip * kStripRows;
  const BlendSources sources = sources_of(job);
  if (job.polar) compute_polar_corners(job, y0, scratch);
  if constexpr (kFeed) compute_camera_corners(job, y0, scratch);
  const int blocks = (job.viewport->width_px + kBlockColumns - 1) / kBlockColumns;
  BlockCoordinates polar;
  FeedCoordinates camera;
  CellRows columns, rows, camera_x, camera_y;
  for (int half_strip = 0; half_strip < 2; ++half_strip) {
    const int top = y0 + half_strip * kCellSide;
    const int bottom = top + kCellSide < job.viewport->height_px ? top + kCellSide : job.viewport->height_px;
    for (int block = 0; block < blocks; ++block) {
      const int x = block * kBlockColumns;
      const bool cells = job.polar && set_polar_cells(job, scratch, half_strip, block, columns, rows);
      const bool camera_cell = kFeed && set_camera_cell(job, scratch, block, camera_x, camera_y);
      for (int y = top; y < bottom; ++y) {
        if (cells) {
          const VF t = set(static_cast<float>(y - top) / kCellSide);
          for (int lane = 0; lane < kBlockColumns; lane += kLanes) {
            place_polar(job, columns.at(lane, t), rows.at(lane, t), lane, polar);
          }
        } else if (job.polar) {
          place_polar_exactly(job, x, y, polar);
        } else {
          place_planar(job, x, y, polar);
        }
        if (kFeed && camera_cell) {
          const VF t = set(static_cast<float>(y - y0) / kStripRows);
          for (int lane = 0; lane < kBlockColumns; lane += kLanes) {
            place_feed(job, camera_x.at(lane, t), camera_y.at(lane, t), set(1.0f), lane, camera);
          }
        } else if (kFeed) {
          project_feed_exactly(job, x, y, camera);
        }
        blend_block<kFeed, kColoured>(sources, polar, camera, job.out->row(y) + 4 * x);
      }
    }
  }
}

void CompositeStripKernel(const ViewportJob& job, int strip, StripScratch& scratch) {
  const bool coloured = job.radiance->ratios() != nullptr;
  if (job.feed.image) {
    return coloured ? composite_strip<true, true>(job, strip, scratch)
                    : composite_strip<true, false>(job, strip, scratch);
  }
  composite_strip<false, false>(job, strip, scratch);
}

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

HWY_EXPORT(CompositeStripKernel);
HWY_EXPORT(PrecomputePixelsKernel);
HWY_EXPORT(CompositePrecomputedKernel);

CompositeStrip composite_strip_for(Isa isa) {
  return kernel_for(isa, [] { return &HWY_DYNAMIC_DISPATCH(CompositeStripKernel); });
}
PrecomputePixels precompute_pixels_for(Isa isa) {
  return kernel_for(isa, [] { return &HWY_DYNAMIC_DISPATCH(PrecomputePixelsKernel); });
}
CompositePrecomputed composite_precomputed_for(Isa isa) {
  return kernel_for(isa, [] { return &HWY_DYNAMIC_DISPATCH(CompositePrecomputedKernel); });
}

}  // namespace herr
#endif
