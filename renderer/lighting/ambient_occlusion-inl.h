// Stage: ambient occlusion. A few short rays per hit, cosine-weighted about the normal; the share that meets
// nothing within the radius multiplies indirect light. All hits of half a 4x4 block of samples turn the same
// local directions into their own frames: rays of a packet of 8 then stay together, which makes them twice as
// fast as directions of their own, at the price of noise that is the same over the half. The halves of three
// by three blocks, wherever they stand, have all strata of directions between them, and each hit takes the
// mean over such a group (occlusion_smoothing-inl.h). Source of that: Keller and Heidrich, "Interleaved
// Sampling", 2001.
#pragma once

#include <array>
#include <cmath>

#include "renderer/direct_light/direct_light-inl.h"
#include "renderer/lighting/occlusion_smoothing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Where the frame of normals turns over. At 0, where Duff et al. have it, rounding would choose between two
// frames of every upright wall; few surfaces are tilted by just this much.
constexpr float kTurnsOver = -0.3104f;

// A vector in the frame of each normal (Duff et al., "Building an Orthonormal Basis,
// Revisited", 2017); z = along it.
HWY_INLINE V3 from_local(const V3& n, const V3& local) {
  const VF one = set(1.0f);
  const VF sign = hn::IfThenElse(hn::Gt(n.z, set(kTurnsOver)), one, set(-1.0f));
  const VF a = hn::Div(set(-1.0f), hn::Add(sign, n.z));
  const VF b = hn::Mul(hn::Mul(n.x, n.y), a);
  const V3 right{hn::MulAdd(hn::Mul(sign, hn::Mul(n.x, n.x)), a, one), hn::Mul(sign, b),
                 hn::Neg(hn::Mul(sign, n.x))};
  const V3 up{b, hn::MulAdd(hn::Mul(n.y, n.y), a, sign), hn::Neg(n.y)};
  return mul_add(local.x, right, mul_add(local.y, up, scale(n, local.z)));
}

// What tells the directions of half a block (4x2 samples) from those of others.
struct OcclusionHalf {
  std::uint32_t random = 0;  // key of its own random numbers
  std::uint32_t frame = 0;   // key of those that all of a frame and eye share
  int stratum = 0;           // of kOcclusionStrata
};
constexpr int kOcclusionStrata = 9 * kBlockHalves;

// Direction `ray` of `rays`, cosine-distributed (Malley's method): radii stratified, with a random place in
// each stratum; angles by the golden ratio, turned by a random number of the frame. Were it one of the group,
// windows that lie across groups would hold angles that leave gaps.
HWY_INLINE std::array<float, 3> local_direction(const OcclusionHalf& half, int ray, int rays) {
  const auto random = [](std::uint32_t key, std::uint32_t counter)
                          HWY_ATTR { return hn::GetLane(unit_float(hash(hn::Set(kU, key), counter))); };
  constexpr float kGolden = 0.618033989f, kTwoPi = 6.28318531f;
  const auto place = static_cast<float>(kOcclusionStrata * ray + half.stratum);
  const float area = (place + random(half.random, 1)) / static_cast<float>(kOcclusionStrata * rays);
  const float turn = random(half.frame, 2) + kGolden * place;
  const float radius = std::sqrt(area);
  return {radius * std::cos(kTwoPi * turn), radius * std::sin(kTwoPi * turn),
          std::sqrt(std::max(0.0f, 1.0f - area))};
}

// The half block whose first sample is (x, y). Which stratum it has changes from frame to frame, so that each
// sees all directions in time.
HWY_INLINE OcclusionHalf occlusion_half(std::uint32_t frame, int x, int y) {
  constexpr int kDown = 3 * kBlockHalves;
  const int column = x / 4, row = y / kHalfRows;
  const float first = hn::GetLane(unit_float(hash(hn::Set(kU, frame), 3)));
  const int place = column % 3 + 3 * (row % kDown);
  OcclusionHalf half;
  half.random =
      frame ^ ((static_cast<std::uint32_t>(row << 16) | static_cast<std::uint32_t>(column)) * 0x9e3779b9u);
  half.frame = frame;
  half.stratum = (place + static_cast<int>(kOcclusionStrata * first)) % kOcclusionStrata;
  return half;
}

// Direction `ray` of each hit of a packet, which may hold both halves of a block.
HWY_INLINE V3 local_directions(const TileJob& job, std::size_t packet, int ray) {
  const int x = job.scratch->packet_x[packet], y = job.scratch->packet_y[packet];
  const auto of_row = [&](int row) HWY_ATTR {
    return local_direction(occlusion_half(job.grid->key, x, row), ray, job.shading->occlusion_rays);
  };
  const std::array<float, 3> first = of_row(y);
  if constexpr (kBlockRows <= kHalfRows) {
    return V3{set(first[0]), set(first[1]), set(first[2])};
  } else {
    const std::array<float, 3> second = of_row(y + kHalfRows);
    const MF upper = hn::FirstN(kF, 4 * kHalfRows);
    const auto both = [&](std::size_t axis)
                          HWY_ATTR { return hn::IfThenElse(upper, set(first[axis]), set(second[axis])); };
    return V3{both(0), both(1), both(2)};
  }
}

// One ray per hit of first hits [0, count), into the queue. A direction that the interpolated normal bends
// below the surface is left out and counts as open: no geometry stands there.
HWY_INLINE void queue_occlusion_rays(const TileJob& job, int ray, int packets) {
  TileScratch& scratch = *job.scratch;
  const HitBatch& hits = scratch.first;
  begin_occlusion_rays(scratch.queue, ray);
  const VI lane = hn::Iota(kI, 0);
  const VF radius = set(job.shading->occlusion_radius_m);
  for (int p = 0; p < packets; ++p) {
    const int slot = p * kLanes;
    const MF surface = hn::Or(of_kind(hits, slot, HitKind::object), of_kind(hits, slot, HitKind::catcher));
    if (hn::AllFalse(kF, surface)) continue;
    const V3 n = load3(hits.normal, slot);
    const V3 g = load3(hits.geometric_normal, slot);
    const V3 direction = from_local(n, local_directions(job, static_cast<std::size_t>(p), ray));
    const MF above = hn::And(surface, hn::Gt(dot(direction, g), hn::Zero(kF)));
    push(scratch.queue, ray_origin(hits, slot), scale(direction, radius), hn::Add(lane, hn::Set(kI, slot)),
         above);
  }
}

// Further hits at edges lie in no blocks: for each what a sample nearby found counts.
HWY_NOINLINE inline void borrow_occlusion(TileScratch& scratch, int packets) {
  const EdgeSamples& samples = *scratch.edges;
  for (int slot = 0; slot < packets * kLanes; slot += kLanes) {
    const auto used = hn::RebindMask(kI, first_lanes(samples.anew_count - slot));
    const VI cells = hn::IfThenElseZero(used, hn::Load(kI, &samples.anew_cell[slot]));
    hn::Store(hn::GatherIndex(kF, samples.open.data(), cells), kF, &scratch.first.open[slot]);
    hn::Store(hn::GatherIndex(kF, samples.open_without.data(), cells), kF, &scratch.first.open_without[slot]);
  }
}

// Fills HitBatch::open and open_without of the first hits.
HWY_NOINLINE inline void ambient_occlusion(const TileJob& job, int packets) {
  TileScratch& scratch = *job.scratch;
  if (scratch.edges && scratch.edges->lights_anew) return borrow_occlusion(scratch, packets);
  HitBatch& hits = scratch.first;
  const int rays = job.shading->occlusion_rays;
  const float share = 1.0f / static_cast<float>(rays);
  for (int slot = 0; slot < packets * kLanes; slot += kLanes) {
    hn::Store(set(1.0f), kF, &hits.open[slot]);
    hn::Store(set(1.0f), kF, &hits.open_without[slot]);
  }
  for (int ray = 0; ray < rays; ++ray) {
    queue_occlusion_rays(job, ray, packets);
    trace_visibility(
        job, hits, true, RayKind::occlusion, RayKind::catcher_occlusion,
        [&](std::size_t hit, float passes) { hits.open[hit] -= share * (1.0f - passes); },
        [&](std::size_t hit, float passes) { hits.open_without[hit] -= share * (1.0f - passes); });
  }
  if (job.shading->occlusion_smoothing) smooth_occlusion(job, packets);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
