// How wide a ray from the eye is: a cone of the solid angle that its sample stands for, so that textures are
// read at the level that the samples can show, and highlights are no narrower. Before: generate_rays. After:
// surfaces, along each ray.
// Source: Akenine-Moeller et al., "Texture Level of Detail Strategies for Real-Time Ray Tracing" (2019).
#pragma once

#include "renderer/tiles/generate_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Radians, as if the cell between samples were square. Of polar samples denser than pixels: a pixel's. A
// planar pixel at angle a off the axis covers step^2 cos^3 a.
HWY_INLINE VF spread_of(const RayGrid& grid, int x, const V3& direction) {
  const VF width = set(grid.ray_width);
  if (grid.polar) {
    return hn::Mul(width,
                   hn::Max(hn::LoadDup128(kF, grid.samples->spread() + x), set(grid.finest_pixel_rad)));
  }
  const VF cosine = hn::Max(dot(direction, set3(grid.gaze)), hn::Zero(kF));
  return hn::Mul(width, hn::Mul(set(grid.finest_pixel_rad), hn::Mul(cosine, hn::Sqrt(cosine))));
}

HWY_NOINLINE inline void set_up_cones(const TileJob& job, int packets) {
  TileScratch& scratch = *job.scratch;
  const RayHit* rays = packets_of(scratch);
  for (int p = 0; p < packets; ++p) {
    const V3 direction = load3(rays[p].ray.dir_x, rays[p].ray.dir_y, rays[p].ray.dir_z);
    const int x = scratch.packet_x[static_cast<std::size_t>(p)];
    hn::Store(hn::Zero(kF), kF, &scratch.first.cone_width[p * kLanes]);
    hn::Store(spread_of(*job.grid, x, direction), kF, &scratch.first.cone_spread[p * kLanes]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
