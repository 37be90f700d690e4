// Each hit's open share as the mean over three by three blocks of 4x4 samples, whose short rays have the nine
// strata of directions between them: of the hits at the same place of each block, those on the same surface.
// Same surface: of the same kind, turned and raised little against the hit, and within half the rays' length.
// At the border of a tile the group is the outermost whole one. Before: ambient_occlusion has traced the
// rays. After: what is lit from all sides. Source: Segovia et al., "Non-interleaved Deferred Shading of
// Interleaved Sample Patterns", 2006.
#pragma once

#include <algorithm>
#include <array>

#include "renderer/tiles/generate_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

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

HWY_INLINE MF on_same_surface(const HitBatch& hits, int slot, int other, float radius_m) {
  const VI kind = hn::Load(kI, &hits.kind[slot]);
  const V3 normal = load3(hits.normal, slot), normal_there = load3(hits.normal, other);
  const V3 there = sub(load3(hits.position, other), load3(hits.position, slot));
  const VF rise = hn::Max(hn::Abs(dot(normal, there)), hn::Abs(dot(normal_there, there)));
  const float farthest = kFarthest_radii * radius_m;
  const MF alike = hn::RebindMask(kF, hn::Eq(kind, hn::Load(kI, &hits.kind[other])));
  const MF near = hn::And(hn::Le(dot(there, there), set(farthest * farthest)),
                          hn::Le(rise, set(kMostRise_radii * radius_m)));
  return hn::And(hn::And(alike, near), hn::Ge(dot(normal, normal_there), set(kLeastTurn)));
}

// The mean goes to scratch.visible and visible_without, which no later stage reads.
HWY_INLINE void mean_of_group(const TileJob& job, const PacketMap& map, int packet) {
  TileScratch& scratch = *job.scratch;
  const HitBatch& hits = scratch.first;
  const int slot = packet * kLanes;
  const auto i = static_cast<std::size_t>(packet);
  const int y = scratch.packet_y[i] - job.y0, within = y % 4 / kBlockRows;
  const int column = std::clamp((scratch.packet_x[i] - job.x0) / 4, 1, std::max(1, map.columns - 2));
  const int row = std::clamp(y / 4, 1, std::max(1, map.rows - 2));
  VF weight = set(1.0f), open = load(&hits.open[slot]), without = load(&hits.open_without[slot]);
  for (int r = row - 1; r <= std::min(row + 1, map.rows - 1); ++r) {
    for (int c = column - 1; c <= std::min(column + 1, map.columns - 1); ++c) {
      const int neighbour = map.at(c, r * (4 / kBlockRows) + within);
      if (neighbour < 0 || neighbour == packet) continue;
      const int other = neighbour * kLanes;
      const MF same = on_same_surface(hits, slot, other, job.shading->occlusion_radius_m);
      weight = hn::Add(weight, hn::IfThenElseZero(same, set(1.0f)));
      open = hn::Add(open, hn::IfThenElseZero(same, load(&hits.open[other])));
      without = hn::Add(without, hn::IfThenElseZero(same, load(&hits.open_without[other])));
    }
  }
  hn::Store(hn::Div(open, weight), kF, &scratch.visible[slot]);
  hn::Store(hn::Div(without, weight), kF, &scratch.visible_without[slot]);
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
