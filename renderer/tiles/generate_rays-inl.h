// Stage: sample positions of a tile -> primary ray packets of 4 columns by kLanes / 4 rows.
// Polar samples that no viewport can see (outside every frustum by more than a sample's reach) are left out.
#pragma once

#include "renderer/tiles/place_ranks.h"
#include "renderer/tiles/ray_packets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

constexpr int kBlockRows = kLanes / 4;

// Lane -> column offset within the packet's block (0..3) and row offset.
HWY_INLINE VI lane_column() {
  return hn::And(hn::Iota(kI, 0), hn::Set(kI, 3));
}
HWY_INLINE VI lane_row() {
  return hn::ShiftRight<2>(hn::Iota(kI, 0));
}

HWY_INLINE V3 polar_directions(const RayGrid& grid, int x, int y, MF& wanted) {
  const PolarSamples& samples = *grid.samples;
  const VF sin_theta = hn::LoadDup128(kF, samples.sin_theta() + x);
  const VF cos_theta = hn::LoadDup128(kF, samples.cos_theta() + x);
  const VF a = hn::Mul(sin_theta, loadu(samples.cos_phi4() + 4 * y));
  const VF b = hn::Mul(sin_theta, loadu(samples.sin_phi4() + 4 * y));
  const V3 direction =
      mul_add(cos_theta, set3(grid.gaze), mul_add(a, set3(grid.right), scale(set3(grid.up), b)));
  const VF reach = hn::Neg(hn::LoadDup128(kF, samples.margin() + x));
  MF seen = first_lanes(0);
  for (int f = 0; f < grid.frustum_count; ++f) {
    VF inside = set(4.0f);
    for (const auto& normal : grid.frusta[static_cast<std::size_t>(f)].normal) {
      inside = hn::Min(inside, dot(set3(normal), direction));
    }
    seen = hn::Or(seen, hn::Ge(inside, reach));
  }
  wanted = hn::And(wanted, seen);
  return direction;
}

// A place in each pixel, [0, 1): the grid's, shifted by a random number of the pixel, around the border.
HWY_INLINE VF place_in_pixel(VU pixel, const RayGrid& grid, std::uint32_t axis, float place) {
  const VF sum = hn::Add(unit_float(hash(hn::Xor(pixel, hn::Set(kU, grid.jitter_key)), axis)), set(place));
  return hn::Sub(sum, hn::Floor(sum));
}

HWY_INLINE V3 planar_directions(const RayGrid& grid, VF column, VF row, VU pixel) {
  VF x = set(0.5f), y = x;
  if (grid.jitter) {
    x = place_in_pixel(pixel, grid, 0, grid.jitter_x);
    y = place_in_pixel(pixel, grid, 1, grid.jitter_y);
  }
  const VF tx = hn::MulAdd(hn::Add(column, x), set(grid.step_x), set(grid.tan_left));
  const VF ty = hn::NegMulAdd(hn::Add(row, y), set(grid.step_y), set(grid.tan_up));
  return normalise(mul_add(tx, set3(grid.right), mul_add(ty, set3(grid.up), set3(grid.gaze))));
}

// Fills scratch packets; returns how many.
HWY_NOINLINE inline int generate_rays(const TileJob& job) {
  const RayGrid& grid = *job.grid;
  TileScratch& scratch = *job.scratch;
  RayHit* packets = packets_of(scratch);
  const V3 origin = set3(grid.origin);
  const VF columns = hn::ConvertTo(kF, lane_column()), rows = hn::ConvertTo(kF, lane_row());
  const int x_end = job.x0 + kTileSide < grid.sink.width ? job.x0 + kTileSide : grid.sink.width;
  const int y_end = job.y0 + kTileSide < grid.sink.height ? job.y0 + kTileSide : grid.sink.height;
  int count = 0;
  for (int y = job.y0; y < y_end; y += kBlockRows) {
    for (int x = job.x0; x < x_end; x += 4) {
      const VF column = hn::Add(columns, set(static_cast<float>(x))),
               row = hn::Add(rows, set(static_cast<float>(y)));
      MF wanted = hn::And(hn::Lt(column, set(static_cast<float>(grid.sink.width))),
                          hn::Lt(row, set(static_cast<float>(grid.sink.height))));
      const VI cell = hn::Add(hn::ShiftLeft<16>(hn::Add(lane_row(), hn::Set(kI, y))),
                              hn::Add(lane_column(), hn::Set(kI, x)));
      const VU pixel = hn::BitCast(kU, cell);
      const V3 direction =
          grid.polar ? polar_directions(grid, x, y, wanted) : planar_directions(grid, column, row, pixel);
      const std::size_t samples = hn::CountTrue(kF, wanted);
      if (samples == 0) continue;
      const MF valid = hn::And(wanted, traceable(origin, direction));
      const std::size_t rays = hn::CountTrue(kF, valid);
      job.counters->polar_samples += static_cast<std::int64_t>(samples);
      job.counters->rays[RayKind::primary] += static_cast<std::int64_t>(rays);
      job.counters->invalid_rays += static_cast<std::int64_t>(samples - rays);

      RayHit& packet = packets[count];
      set_rays(packet, origin, direction);
      const VU key = hash(pixel, grid.key);
      if (job.shading->plan->voxels) set_chance(packet.ray, key);
      const auto slot = static_cast<std::size_t>(count);
      set_valid(scratch.packet_valid[slot].data(), valid);
      scratch.packet_x[slot] = x;
      scratch.packet_y[slot] = y;
      // Samples that are wanted keep their place even when the ray is not traceable:
      // they show the background.
      hn::Store(key, kU, scratch.first.key.data() + count * kLanes);
      hn::Store(hn::IfThenElseZero(hn::RebindMask(kI, wanted), hn::Set(kI, static_cast<int>(HitKind::miss))),
                kI, scratch.first.kind.data() + count * kLanes);
      const auto block = static_cast<std::uint8_t>((y - job.y0) / 4 * kBlocksAlong + (x - job.x0) / 4);
      std::fill_n(scratch.first.block.begin() + count * kLanes, kLanes, block);
      for (int i = 0; i < kLanes; ++i) {
        scratch.first.rank[static_cast<std::size_t>(count * kLanes + i)] =
            rank_of_place(x + i % 4, y + i / 4);
      }
      ++count;
    }
  }
  return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
