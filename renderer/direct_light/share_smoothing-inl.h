// What hits in wide penumbrae see of a lamp, from the rays of those around them: a window of 3x3 hits, those
// beside the middle counting half and those in the corners a quarter. Only hits on the same surface count,
// and only in pairs that lie opposite each other, so that a steady slope of what is seen stays as it is, at
// borders of tiles and surfaces too. Before: mixed_blocks-inl.h says which hits ask for rays of their own.
#pragma once

#include <algorithm>
#include <array>

#include "renderer/direct_light/light_of_points-inl.h"
#include "renderer/direct_light/mixed_blocks-inl.h"
#include "renderer/tiles/generate_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Hits whose rays are enough for one that takes them, by their weights: itself, and a pair at least.
constexpr float kFewestInWindow = 2;

// Calls copy(slot, place) for each four hits that lie next to one another in a batch and in the tile.
template <typename Copy>
HWY_INLINE void for_each_four(const TileJob& job, int packets, const Copy& copy) {
  const TileScratch& scratch = *job.scratch;
  for (int p = 0; p < packets; ++p) {
    const auto i = static_cast<std::size_t>(p);
    const int x = scratch.packet_x[i] - job.x0, y = scratch.packet_y[i] - job.y0;
    for (int row = 0; row < kBlockRows; ++row)
      copy(static_cast<std::size_t>(p * kLanes + 4 * row), TilePlaces::place(x, y + row));
  }
}

// Lays out what hits know, as many rays of each as mixed hits have: of those that decided, all or none are
// blocked.
HWY_NOINLINE inline void lay_out(const TileJob& job, const HitBatch& hits, int packets, int rays,
                                 const PlaceSums& sums, TilePlaces& places) {
  const AdaptiveLight& adaptive = *job.scratch->adaptive;
  places.kind.fill(0);
  places.wanted.fill(0);
  for_each_four(job, packets, [&](std::size_t slot, std::size_t place) {
    const auto put = [&](const Lane<float>& from, TilePlaces::Plane& to) {
      std::copy_n(&from[slot], 4, &to[place]);
    };
    put(hits.position.x, places.position[0]);
    put(hits.position.y, places.position[1]);
    put(hits.position.z, places.position[2]);
    put(hits.normal.x, places.normal[0]);
    put(hits.normal.y, places.normal[1]);
    put(hits.normal.z, places.normal[2]);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t hit = slot + i, to = place + i;
      const bool mixed = adaptive.mixed[hit] != 0;
      const bool counts = adaptive.faced[hit] > 0 && !(mixed && adaptive.by_samples[hit] != 0);
      places.kind[to] = counts ? static_cast<float>(hits.kind[hit]) : 0.0f;
      places.wanted[to] = adaptive.mixed[hit] - adaptive.asks[hit];
      for (std::size_t axis = 0; axis < 3; ++axis)
        places.all_places[axis][to] = sums.of_axis[axis][static_cast<std::size_t>(adaptive.start[hit])];
      const auto lay = [&](const BlockedSums<Lane<float>>& from, const Lane<float>& first,
                           BlockedSums<TilePlaces::Plane>& blocked) {
        const float all = first[hit] > 0 ? 0.0f : 1.0f;
        blocked.count[to] = mixed ? from.count[hit] : all * static_cast<float>(rays);
        for (std::size_t axis = 0; axis < 3; ++axis)
          blocked.places[axis][to] = mixed ? from.places[axis][hit] : all * places.all_places[axis][to];
      };
      lay(adaptive.blocked, adaptive.seen, places.blocked);
      lay(adaptive.blocked_without, adaptive.seen_without, places.blocked_without);
    }
  });
}

HWY_INLINE VF at(const TilePlaces::Plane& plane, std::size_t place) {
  return hn::LoadU(kF, &plane[place]);
}
HWY_INLINE V3 at(const std::array<TilePlaces::Plane, 3>& planes, std::size_t place) {
  return {at(planes[0], place), at(planes[1], place), at(planes[2], place)};
}

// Two places of a window, opposite each other.
struct Pair {
  std::size_t ahead = 0, behind = 0;
  VF weight;  // 0 for hits of which either is not on the same surface
};
struct Window {
  std::size_t middle = 0;
  std::array<Pair, 4> pairs;
  std::size_t count = 0;

  HWY_INLINE VF sum(const TilePlaces::Plane& plane) const {
    VF sum = at(plane, middle);
    for (const Pair& pair : std::span(pairs).first(count))
      sum = hn::MulAdd(pair.weight, hn::Add(at(plane, pair.ahead), at(plane, pair.behind)), sum);
    return sum;
  }
  HWY_INLINE VF hits() const {
    VF sum = set(1.0f);
    for (const Pair& pair : std::span(pairs).first(count)) sum = hn::MulAdd(set(2.0f), pair.weight, sum);
    return sum;
  }
};

HWY_INLINE MF on_surface_of(const TilePlaces& places, std::size_t place, std::size_t other) {
  const V3 normal = at(places.normal, place), normal_there = at(places.normal, other);
  const V3 gap = sub(at(places.position, other), at(places.position, place));
  const VF rise = hn::Max(hn::Abs(dot(normal, gap)), hn::Abs(dot(normal_there, gap)));
  const MF flat = hn::Le(hn::Mul(rise, rise), hn::Mul(set(kSameRise2), dot(gap, gap)));
  const MF alike = hn::And(hn::Eq(at(places.kind, place), at(places.kind, other)),
                           hn::Gt(dot(normal, normal_there), set(kSameTurn)));
  return hn::And(alike, flat);
}

HWY_INLINE Window window_around(const TilePlaces& places, std::size_t middle) {
  Window window;
  window.middle = middle;
  for (int dy = 0; dy <= 1; ++dy) {
    for (int dx = dy == 0 ? 1 : -1; dx <= 1; ++dx) {
      const float weight = (dy == 0 ? 1.0f : 0.5f) * (dx == 0 ? 1.0f : 0.5f);
      const auto step = static_cast<std::size_t>(dy * TilePlaces::kStride + dx);
      const std::size_t ahead = middle + step, behind = middle - step;
      const MF both = hn::And(on_surface_of(places, middle, ahead), on_surface_of(places, middle, behind));
      if (hn::AllFalse(kF, both)) continue;
      window.pairs[window.count++] = {ahead, behind, hn::IfThenElseZero(both, set(weight))};
    }
  }
  return window;
}

HWY_INLINE void take_fit(const Window& window, VF rays, const std::array<VF, 3>& all_places,
                         const BlockedSums<TilePlaces::Plane>& blocked,
                         BlockedSums<TilePlaces::Plane>& seen) {
  const VisibleFit fit(
      rays, all_places, window.sum(blocked.count),
      {window.sum(blocked.places[0]), window.sum(blocked.places[1]), window.sum(blocked.places[2])});
  hn::StoreU(fit.mean, kF, &seen.count[window.middle]);
  for (std::size_t axis = 0; axis < 3; ++axis)
    hn::StoreU(fit.slope[axis], kF, &seen.places[axis][window.middle]);
}

// Mixed hits that do not ask take what their window saw; where it holds too few hits, they ask on. `packets`
// of first hits, in their places; `rays` and `sums`: of mixed hits so far.
HWY_NOINLINE inline void smooth_shares(const TileJob& job, const HitBatch& hits, int packets, int rays,
                                       const PlaceSums& sums) {
  AdaptiveLight& adaptive = *job.scratch->adaptive;
  TilePlaces& places = adaptive.places;
  lay_out(job, hits, packets, rays, sums, places);
  const VF zero = hn::Zero(kF);
  for (int y = 0; y < kTileSide; ++y) {
    for (int x = 0; x < kTileSide; x += kLanes) {
      const std::size_t place = TilePlaces::place(x, y);
      const MF wanted = hn::Gt(at(places.wanted, place), zero);
      if (hn::AllFalse(kF, wanted)) continue;
      const Window window = window_around(places, place);
      const VF hits_in_window = window.hits();
      const MF enough = hn::And(wanted, hn::Ge(hits_in_window, set(kFewestInWindow)));
      hn::StoreU(hn::IfThenElseZero(enough, set(1.0f)), kF, &places.enough[place]);
      const VF all_rays = hn::Mul(hits_in_window, set(static_cast<float>(rays)));
      const std::array<VF, 3> all_places{window.sum(places.all_places[0]), window.sum(places.all_places[1]),
                                         window.sum(places.all_places[2])};
      take_fit(window, all_rays, all_places, places.blocked, places.seen);
      take_fit(window, all_rays, all_places, places.blocked_without, places.seen_without);
    }
  }
  for_each_four(job, packets, [&](std::size_t slot, std::size_t place) {
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t hit = slot + i, from = place + i;
      if (places.wanted[from] == 0) continue;
      const bool enough = places.enough[from] != 0;
      adaptive.smoothed[hit] = enough ? 1.0f : 0.0f;
      adaptive.asks[hit] = enough ? 0.0f : 1.0f;
      if (!enough) continue;
      const auto take = [&](const BlockedSums<TilePlaces::Plane>& seen, BlockedSums<Lane<float>>& to) {
        to.count[hit] = seen.count[from];
        for (std::size_t axis = 0; axis < 3; ++axis) to.places[axis][hit] = seen.places[axis][from];
      };
      take(places.seen, adaptive.blocked);
      take(places.seen_without, adaptive.blocked_without);
    }
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
