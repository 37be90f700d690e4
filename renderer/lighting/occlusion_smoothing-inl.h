// Each hit's open share as the mean over three by three blocks of 4x4 samples, whose halves' short rays have
// all strata of directions between them: of the hits at the same place of each half, those on the same
// surface: of the same kind, turned and raised little against the hit, and within half the rays' length. At
// the border of a tile the group is the outermost whole one. Before: ambient_occlusion has traced the rays.
// After: what is lit from all sides. Source: Segovia et al., "Non-interleaved Deferred Shading of Interleaved
// Sample Patterns", 2006.
#pragma once

#include <algorithm>
#include <array>

#include "renderer/tiles/generate_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Short rays of half a block share their directions.
constexpr int kHalfRows = 2;
constexpr int kBlockHalves = 4 / kHalfRows;

constexpr int kPacketRowsInTile = kTileSide / kBlockRows;

// Which packet holds each place of the tile; -1: none.
struct PacketMap {
  std::array<std::int16_t, static_cast<std::size_t>(kBlocksAlong* kPacketRowsInTile)> packet;
  int columns = 0, rows = 0;  // blocks of the tile that lie in the picture

  int at(int column, int row) const { return packet[static_cast<std::size_t>(row * kBlocksAlong + column)]; }
};

HWY_INLINE PacketMap map_packets(const TileJob& job, int packets) {
  const TileScratch& scratch = *job.scratch;
  PacketMap map;
  map.packet.fill(-1);
  for (int p = 0; p < packets; ++p) {
    const auto i = static_cast<std::size_t>(p);
    const int column = (scratch.packet_x[i] - job.x0) / 4, row = (scratch.packet_y[i] - job.y0) / kBlockRows;
    map.packet[static_cast<std::size_t>(row * kBlocksAlong + column)] = static_cast<std::int16_t>(p);
  }
  map.columns = std::min(kBlocksAlong, (job.grid->sink.width - job.x0 + 3) / 4);
  map.rows = std::min(kBlocksAlong, (job.grid->sink.height - job.y0 + 3) / 4);
  return map;
}

// How much hits are taken for neighbours on one surface.
constexpr float kLeastTurn = 0.9f;       // cosine between their normals
constexpr float kMostRise_radii = 0.1f;  // of either above the plane of the other
constexpr float kFarthest_radii = 0.5f;

// A packet as a neighbour of another: lane by lane, or, where packets hold whole blocks, the other half of
// the block.
template <bool kOtherHalf>
struct Neighbours {
  template <typename D, typename V>
  static HWY_INLINE V lanes(D d, V v) {
    if constexpr (kOtherHalf) return hn::ConcatLowerUpper(d, v, v);
    return v;
  }
  static HWY_INLINE VF load_at(const Lane<float>& lane, int slot) { return lanes(kF, load(&lane[slot])); }
  static HWY_INLINE V3 load_at(const Lane3& lane, int slot) {
    const V3 v = load3(lane, slot);
    return V3{lanes(kF, v.x), lanes(kF, v.y), lanes(kF, v.z)};
  }
};

template <typename There>
HWY_INLINE MF on_same_surface(const HitBatch& hits, int slot, int other, float radius_m) {
  const VI kind = hn::Load(kI, &hits.kind[slot]),
           kind_there = There::lanes(kI, hn::Load(kI, &hits.kind[other]));
  const V3 normal = load3(hits.normal, slot), normal_there = There::load_at(hits.normal, other);
  const V3 there = sub(There::load_at(hits.position, other), load3(hits.position, slot));
  const VF rise = hn::Max(hn::Abs(dot(normal, there)), hn::Abs(dot(normal_there, there)));
  const float farthest = kFarthest_radii * radius_m;
  const MF alike = hn::RebindMask(kF, hn::Eq(kind, kind_there));
  const MF near = hn::And(hn::Le(dot(there, there), set(farthest * farthest)),
                          hn::Le(rise, set(kMostRise_radii * radius_m)));
  return hn::And(hn::And(alike, near), hn::Ge(dot(normal, normal_there), set(kLeastTurn)));
}

// Sums over hits on the same surface, which begin with the hit itself.
struct OpenSums {
  VF weight, open, without;

  template <typename There>
  HWY_INLINE void add(const HitBatch& hits, int slot, int other, float radius_m) {
    const MF same = on_same_surface<There>(hits, slot, other, radius_m);
    weight = hn::Add(weight, hn::IfThenElseZero(same, set(1.0f)));
    open = hn::Add(open, hn::IfThenElseZero(same, There::load_at(hits.open, other)));
    without = hn::Add(without, hn::IfThenElseZero(same, There::load_at(hits.open_without, other)));
  }
};

// Adds the hits of a block at the same places of both halves.
HWY_INLINE void add_block(const TileJob& job, const PacketMap& map, int column, int row, int packet,
                          OpenSums& sums) {
  const HitBatch& hits = job.scratch->first;
  const int slot = packet * kLanes;
  const float radius_m = job.shading->occlusion_radius_m;
  const int within = job.scratch->packet_y[static_cast<std::size_t>(packet)] % kHalfRows;
  for (int half = 0; half < kBlockHalves; ++half) {
    const int there = map.at(column, (4 * row + kHalfRows * half + within) / kBlockRows);
    if (there < 0) continue;
    if constexpr (kBlockRows == 4) {
      if (half == 1) {
        sums.add<Neighbours<true>>(hits, slot, there * kLanes, radius_m);
        continue;
      }
    }
    if (there != packet) sums.add<Neighbours<false>>(hits, slot, there * kLanes, radius_m);
  }
}

// The mean goes to scratch.visible and visible_without, which no later stage reads.
HWY_INLINE void mean_of_group(const TileJob& job, const PacketMap& map, int packet) {
  TileScratch& scratch = *job.scratch;
  const HitBatch& hits = scratch.first;
  const int slot = packet * kLanes;
  const auto i = static_cast<std::size_t>(packet);
  const int x = scratch.packet_x[i] - job.x0, y = scratch.packet_y[i] - job.y0;
  const int column = std::clamp(x / 4, 1, std::max(1, map.columns - 2));
  const int row = std::clamp(y / 4, 1, std::max(1, map.rows - 2));
  OpenSums sums{set(1.0f), load(&hits.open[slot]), load(&hits.open_without[slot])};
  for (int r = row - 1; r <= std::min(row + 1, map.rows - 1); ++r) {
    for (int c = column - 1; c <= std::min(column + 1, map.columns - 1); ++c) {
      add_block(job, map, c, r, packet, sums);
    }
  }
  hn::Store(hn::Div(sums.open, sums.weight), kF, &scratch.visible[slot]);
  hn::Store(hn::Div(sums.without, sums.weight), kF, &scratch.visible_without[slot]);
}

HWY_NOINLINE inline void smooth_occlusion(const TileJob& job, int packets) {
  TileScratch& scratch = *job.scratch;
  HitBatch& hits = scratch.first;
  const PacketMap map = map_packets(job, packets);
  for (int p = 0; p < packets; ++p) mean_of_group(job, map, p);
  for (int slot = 0; slot < packets * kLanes; slot += kLanes) {
    hn::Store(load(&scratch.visible[slot]), kF, &hits.open[slot]);
    hn::Store(load(&scratch.visible_without[slot]), kF, &hits.open_without[slot]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
