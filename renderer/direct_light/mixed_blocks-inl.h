// Where the first rays of a 4x4 block disagree, its hits are in a penumbra. Hits of one block decide together
// where they lie on one surface. Scalar. Before: adaptive_light-inl.h has traced the first rounds. After:
// share_smoothing-inl.h.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "renderer/direct_light/light_samples-inl.h"
#include "renderer/tiles/place_ranks.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Hits on one surface of a block from which on their first rays are enough to say that all of the lamp is
// seen, or nothing.
constexpr float kFewestTogether = 8;
// What is seen of a lamp by one half of a block and by the other: from this difference on hits need rays of
// their own.
constexpr float kSteep = 0.15f;
// Two hits are on one surface where the cosine between their normals is above the first, and the square of
// their height above each other's plane at most this share of their squared distance.
constexpr float kSameTurn = 0.9f, kSameRise2 = 0.04f;

// What rays of hits saw, with the virtual objects and without them.
struct SeenRays {
  float asked = 0;
  std::array<float, 2> seen{};

  void add(float more_asked, float more_seen, float more_without) {
    asked += more_asked;
    seen[0] += more_seen;
    seen[1] += more_without;
  }
  float apart_from(const SeenRays& other) const {
    if (asked == 0 || other.asked == 0) return 0;
    float most = 0;
    for (std::size_t i = 0; i < seen.size(); ++i)
      most = std::max(most, std::abs(seen[i] / asked - other.seen[i] / other.asked));
    return most;
  }
};

// The hits of a block that lie on one surface: what their first rays saw, and, once it is mixed, those of
// each half.
struct BlockSurface {
  std::size_t first_hit = 0;
  SeenRays first, left, right, upper, lower;
  bool mixed = false;

  bool sees_part() const {
    return std::any_of(first.seen.begin(), first.seen.end(),
                       [&](float seen) { return seen > 0 && seen < first.asked; });
  }
  bool steep() const { return left.apart_from(right) > kSteep || upper.apart_from(lower) > kSteep; }
};

// Of each block up to four surfaces; hits of further ones decide alone.
struct BlockSurfaces {
  static constexpr std::size_t kMost = 4;
  std::array<std::array<BlockSurface, kMost>, kBlocksInTile> of{};
  std::array<std::size_t, kBlocksInTile> count{};
  std::array<BlockSurface*, kTileRays> of_hit{};  // null: none, or one too many
};

// Turned alike, and each little above the plane of the other.
inline bool one_surface(const HitBatch& hits, std::size_t a, std::size_t b) {
  if (hits.kind[a] != hits.kind[b]) return false;
  const auto at = [](const Lane3& lanes, std::size_t i) {
    return std::array<float, 3>{lanes.x[i], lanes.y[i], lanes.z[i]};
  };
  const std::array<float, 3> n = at(hits.normal, a), m = at(hits.normal, b), p = at(hits.position, a),
                             q = at(hits.position, b);
  float turned = 0, above_a = 0, above_b = 0, apart2 = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const float gap = q[i] - p[i];
    turned += n[i] * m[i];
    above_a += n[i] * gap, above_b += m[i] * gap;
    apart2 += gap * gap;
  }
  const float rise = std::max(std::abs(above_a), std::abs(above_b));
  return turned > kSameTurn && rise * rise <= kSameRise2 * apart2;
}

// The surface of its block that a hit belongs to; null where the block has too many.
inline BlockSurface* surface_of(const HitBatch& hits, std::size_t hit, BlockSurfaces& blocks) {
  const std::size_t block = hits.block[hit];
  auto& surfaces = blocks.of[block];
  std::size_t& count = blocks.count[block];
  for (std::size_t s = 0; s < count; ++s)
    if (one_surface(hits, surfaces[s].first_hit, hit)) return &surfaces[s];
  if (count == BlockSurfaces::kMost) return nullptr;
  surfaces[count].first_hit = hit;
  return &surfaces[count++];
}

// One of the four blocks beside `block` sees part of the light on the same surface: what hides the rest may
// reach into this one, too, beside its rays.
inline bool beside_part(const HitBatch& hits, const BlockSurfaces& blocks, std::size_t block,
                        const BlockSurface& surface) {
  const auto there = [&](std::size_t other) {
    for (std::size_t s = 0; s < blocks.count[other]; ++s) {
      const BlockSurface& beside = blocks.of[other][s];
      if (beside.sees_part() && one_surface(hits, surface.first_hit, beside.first_hit)) return true;
    }
    return false;
  };
  const std::size_t column = block % kBlocksAlong, row = block / kBlocksAlong;
  return (column > 0 && there(block - 1)) || (column + 1 < kBlocksAlong && there(block + 1)) ||
         (row > 0 && there(block - kBlocksAlong)) || (row + 1 < kBlocksAlong && there(block + kBlocksAlong));
}

// Fills `mixed` of hits [0, count), after the first rounds; false: none is. The blocks of edge rays and of
// glass may lie in several batches, of which each decides for itself.
HWY_NOINLINE inline bool find_mixed(const LightRecord& light, const HitBatch& hits, int count,
                                    BlockSurfaces& blocks, AdaptiveLight& adaptive) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    if (adaptive.faced[i] == 0) continue;
    BlockSurface* surface = surface_of(hits, i, blocks);
    if (surface != nullptr) surface->first.add(adaptive.faced[i], adaptive.seen[i], adaptive.seen_without[i]);
    blocks.of_hit[i] = surface;
  }
  const float fewest = kFewestTogether * static_cast<float>(light.first_samples);
  for (std::size_t block = 0; block < kBlocksInTile; ++block) {
    for (BlockSurface& surface : std::span(blocks.of[block]).first(blocks.count[block])) {
      surface.mixed =
          surface.sees_part() || surface.first.asked < fewest || beside_part(hits, blocks, block, surface);
    }
  }
  bool any = false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const BlockSurface* surface = blocks.of_hit[i];
    const bool mixed = adaptive.faced[i] > 0 && (surface == nullptr || surface->mixed);
    adaptive.mixed[i] = mixed ? 1.0f : 0.0f;
    any = any || mixed;
  }
  return any;
}

// Fills `asks` of hits [0, count): those that are mixed, and not to take the rays of others. `rounds`: how
// many of mixed hits so far.
HWY_NOINLINE inline void find_lonely(const HitBatch& hits, int count, float rounds, BlockSurfaces& blocks,
                                     AdaptiveLight& adaptive) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    BlockSurface* surface = blocks.of_hit[i];
    if (adaptive.mixed[i] == 0 || adaptive.by_samples[i] != 0 || surface == nullptr) continue;
    const float with = rounds - adaptive.blocked.count[i],
                without = rounds - adaptive.blocked_without.count[i];
    (column_of_rank(hits.rank[i]) < 2 ? surface->left : surface->right).add(rounds, with, without);
    (row_of_rank(hits.rank[i]) < 2 ? surface->upper : surface->lower).add(rounds, with, without);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const BlockSurface* surface = blocks.of_hit[i];
    const bool lonely =
        surface == nullptr || surface->steep() || adaptive.by_samples[i] != 0 || adaptive.shiny[i] != 0;
    adaptive.asks[i] = adaptive.mixed[i] != 0 && lonely ? 1.0f : 0.0f;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
