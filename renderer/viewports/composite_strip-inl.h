// Stage: radiance buffer -> viewport pixels, composited over the re-projected camera feed, a strip of 16 rows
// a job. Compiled once for each instruction set (simd/kernel_instance.cpp.in).
#pragma once

#include "renderer/viewports/block_coordinates-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Per-lane pieces of a cell: value at row t of the cell is at_top + t * per_row, plus t (1 - t) * bend where
// the cell is quadratic.
struct alignas(64) CellRows {
  float at_top[kBlockColumns], per_row[kBlockColumns];
  float bend = 0;
  HWY_INLINE VF at(int lane, VF t) const { return hn::MulAdd(t, load(&per_row[lane]), load(&at_top[lane])); }
  HWY_INLINE VF bent_at(int lane, VF t) const {
    return hn::MulAdd(hn::Mul(t, hn::Sub(set(1.0f), t)), set(bend), at(lane, t));
  }
};

HWY_INLINE void set_cell(CellRows& rows, int first, int columns, float c00, float c10, float c01, float c11) {
  const float across = c10 - c00, down = c01 - c00, twist = (c11 - c01) - across;
  for (int i = 0; i < columns; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(columns);
    rows.at_top[first + i] = c00 + t * across;
    rows.per_row[first + i] = down + t * twist;
  }
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
  const int corners = job.viewport->width_px / kBlockColumns + 3;
  for (int r = 0; r < 3; ++r) {
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

// One coordinate of a camera cell from 3x3 corners (stride apart, this cell's four and the next ones):
// quadratic along each axis. False when its curvature is too great for that.
HWY_INLINE bool set_quadratic_cell(CellRows& rows, const float* corner, std::size_t stride) {
  const float* c = corner;
  const float bend_x = c[0] - 2 * c[1] + c[2], bend_y = c[0] - 2 * c[stride] + c[2 * stride];
  // A straight cell would be off by an eighth of these: 1/32 pixel at most. The quadratic term leaves the
  // third difference, a small part of that for a lens.
  constexpr float kLargestBend_px = 0.25f;
  if (!(std::abs(bend_x) + std::abs(bend_y) <= kLargestBend_px)) return false;
  set_cell(rows, 0, kBlockColumns, c[0], c[1], c[stride], c[stride + 1]);
  for (int i = 0; i < kBlockColumns; ++i) {
    const float t = static_cast<float>(i) / kBlockColumns;
    rows.at_top[i] -= 0.5f * t * (1 - t) * bend_x;
  }
  rows.bend = -0.5f * bend_y;
  return true;
}

HWY_INLINE bool set_camera_cell(const StripScratch& scratch, int block, CellRows& xs, CellRows& ys) {
  const auto at = static_cast<std::size_t>(block);
  for (std::size_t r = 0; r < 3; ++r) {
    const std::uint8_t* valid = &scratch.camera_valid[r * scratch.camera_stride + at];
    if (!valid[0] || !valid[1] || !valid[2]) return false;
  }
  return set_quadratic_cell(xs, &scratch.camera_x[at], scratch.camera_stride) &&
         set_quadratic_cell(ys, &scratch.camera_y[at], scratch.camera_stride);
}

template <ResampleFilter kFilter, bool kFeed, bool kColoured>
void composite_strip_with(const ViewportJob& job, int strip, StripScratch& scratch) {
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
      const bool camera_cell = kFeed && set_camera_cell(scratch, block, camera_x, camera_y);
      for (int y = top; y < bottom; ++y) {
        if (cells) {
          const VF t = set(static_cast<float>(y - top) / kCellSide);
          for (int lane = 0; lane < kBlockColumns; lane += kLanes) {
            place_polar(job, columns.at(lane, t), rows.at(lane, t), lane, polar);
          }
        } else if (job.polar) {
          place_polar_exactly(job, x, y, polar);
        } else if (job.one_texel_per_pixel()) {
          place_planar(job, x, y, polar);
        } else {
          place_scaled(job, x, y, polar);
        }
        if (kFeed && camera_cell) {
          const VF t = set(static_cast<float>(y - y0) / kStripRows);
          for (int lane = 0; lane < kBlockColumns; lane += kLanes) {
            place_feed(job, camera_x.bent_at(lane, t), camera_y.bent_at(lane, t), set(1.0f), lane, camera);
          }
        } else if (kFeed) {
          project_feed_exactly(job, x, y, camera);
        }
        blend_block<kFilter, kFeed, kColoured>(sources, polar, camera, job.out->row(y) + 4 * x);
      }
    }
  }
}

template <ResampleFilter kFilter>
void composite_strip_by(const ViewportJob& job, int strip, StripScratch& scratch) {
  const bool coloured = job.radiance->ratios() != nullptr;
  if (job.feed.image) {
    return coloured ? composite_strip_with<kFilter, true, true>(job, strip, scratch)
                    : composite_strip_with<kFilter, true, false>(job, strip, scratch);
  }
  composite_strip_with<kFilter, false, false>(job, strip, scratch);
}

void composite_strip(const ViewportJob& job, int strip, StripScratch& scratch) {
  switch (job.filter) {
    case ResampleFilter::nearest:
      return composite_strip_by<ResampleFilter::nearest>(job, strip, scratch);
    case ResampleFilter::bilinear:
      return composite_strip_by<ResampleFilter::bilinear>(job, strip, scratch);
    case ResampleFilter::bicubic:
      return composite_strip_by<ResampleFilter::bicubic>(job, strip, scratch);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
