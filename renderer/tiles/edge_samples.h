// What a tile remembers of its samples while further rays go through those at edges: of each sample, row by
// row, the surface that it shows and its texel. A border of one sample runs around the tile, so that a
// sample's neighbours are found without a branch; nothing is known of it (EdgeSamples::kNone).
#pragma once

#include <array>
#include <cstdint>

#include "renderer/tiles/hit_lanes.h"

namespace herr {

// Lights whose shadows have edges, of those that a scene has.
inline constexpr int kMostEdgeLights = 31;

struct alignas(64) EdgeSamples {
  static constexpr int kStride = kTileSide + 2;
  static constexpr std::int32_t kNone = -2, kMissed = -1;
  // Bits of `marks`: a neighbour shows another surface; the same one, where another light is blocked; the
  // same one, which looks much different there; and that the first two are worth all further rays. From
  // kFirstSide on: EdgePlaces' sides where the first two lie.
  static constexpr std::int32_t kSurfaceEdge = 1, kShadowEdge = 2, kShadingEdge = 4, kStrongEdge = 8,
                                kFirstSide = 16;

  // Index of sample (column, row) of the tile in pictures, each in [-1, kTileSide].
  static constexpr int at(int column, int row) { return (row + 1) * kStride + column + 1; }
  template <typename T>
  using Picture = std::array<T, kStride * kStride + 2 * kMaxLanes>;
  struct Picture3 {
    Picture<float> x, y, z;
  };

  // Samples at edges: column and row in the tile, what one of their rays counts, and what these add up to.
  Lane<std::int32_t> column, row;
  Lane<float> share;
  Lane3 light_sum, ratio_sum;
  // Further rays that wait, and those of samples whose surface looks much different beside them, which are
  // lit anew whatever they meet: (place << 16) + sample in the list above. A sample's own lie side by side.
  Lane<std::int32_t> rays, rays_lit_anew;
  // Rays whose hits are lit anew: where they go, a number as above, and the cell of the sample nearby whose
  // short rays count for them.
  Lane<std::int32_t> anew, anew_cell;
  Lane3 anew_direction;
  Lane<std::int32_t> blocked_at;  // `blocked` per hit, while the tile is lit

  Picture<std::int32_t> surface;  // number of the instance, or one of the above
  Picture3 position, normal;      // of the first hit, as HitBatch::position and geometric_normal
  Picture<float> offset;          // as HitBatch::offset
  Picture<std::int32_t> blocked;  // bit per light of one sample: something is in its way
  Picture<std::int32_t> kind;     // HitKind
  Picture<std::int32_t> marks;
  Picture<float> open, open_without;  // as HitBatch::open
  Picture3 light, ratio;              // the texel

  int count = 0, ray_count = 0, lit_anew_count = 0, anew_count = 0;
  bool notes = false;        // the tile's samples are in work, their first layer
  bool lights_anew = false;  // the list of hits that are lit anew is
  // Where the tile's packets lie: those of hits that are lit anew take their places.
  std::array<std::int32_t, kTileRays / 4> packet_x, packet_y;
  int packets = 0;
};

}  // namespace herr
