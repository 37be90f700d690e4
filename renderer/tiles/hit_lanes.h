// How large a tile is, and one value or vector for each of its rays: what tile_job.h is made of.
#pragma once

#include <array>
#include <cstddef>

namespace herr {

inline constexpr int kTileSide = 32;
inline constexpr int kTileRays = kTileSide * kTileSide;
inline constexpr int kMaxLanes = 16;
// Blocks of 4x4 samples: neighbours that decide together, halves of which share directions, on every
// instruction set.
inline constexpr int kBlocksAlong = kTileSide / 4;
inline constexpr std::size_t kBlocksInTile = kBlocksAlong * kBlocksAlong;

// One value per ray of a batch, with room for a last partial vector.
template <typename T>
using Lane = std::array<T, kTileRays + kMaxLanes>;

// A vector or a colour (x red, y green, z blue) per ray of a batch.
struct Lane3 {
  Lane<float> x, y, z;
};

}  // namespace herr
