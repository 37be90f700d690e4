// Stage: ambient occlusion. A few short rays per hit, cosine-weighted about the normal; the share that meets
// nothing within the radius multiplies indirect light. All hits of a 4x4 block of samples turn the same local
// directions into their own frames: rays of a packet then stay together, which makes them twice as fast as
// directions of their own, at the price of noise that is the same over the block. Three by three blocks
// divide strata of directions among them, and each hit takes the mean over such a group
// (occlusion_smoothing-inl.h). Source of that: Keller and Heidrich, "Interleaved Sampling", 2001.
#pragma once

#include <cmath>

#include "renderer/lighting/direct_light-inl.h"
#include "renderer/lighting/occlusion_smoothing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Where the frame of normals turns over. At 0, where Duff et al. have it, rounding would choose between two
// frames of every upright wall; few surfaces are tilted by just this much.
constexpr float kTurnsOver = -0.3104f;

// A vector in the frame of each normal (Duff et al., "Building an Orthonormal Basis,
// Revisited", 2017); z = along it.
HWY_INLINE V3 from_local(const V3& n, const float local[3]) {
  const VF one = set(1.0f);
  const VF sign = hn::IfThenElse(hn::Gt(n.z, set(kTurnsOver)), one, set(-1.0f));
  const VF a = hn::Div(set(-1.0f), hn::Add(sign, n.z));
  const VF b = hn::Mul(hn::Mul(n.x, n.y), a);
  const V3 right{hn::MulAdd(hn::Mul(sign, hn::Mul(n.x, n.x)), a, one), hn::Mul(sign, b),
                 hn::Neg(hn::Mul(sign, n.x))};
  const V3 up{b, hn::MulAdd(hn::Mul(n.y, n.y), a, sign), hn::Neg(n.y)};
  return mul_add(set(local[0]), right, mul_add(set(local[1]), up, scale(n, set(local[2]))));
}

// Where a 4x4 block stands: it takes one of the nine strata into which three by three blocks divide each
// ray's.
struct OcclusionBlock {
  std::uint32_t random = 0;  // key of its own random numbers
  std::uint32_t group = 0;   // key of those of three by three blocks
  int stratum = 0;           // of kOcclusionStrata
};
constexpr int kOcclusionStrata = 9;

// Direction `ray` of `rays`, cosine-distributed (Malley's method): radii stratified, with a random place in
// each stratum; angles by the golden ratio, turned by a random number of the group.
HWY_INLINE void local_direction(const OcclusionBlock& block, int ray, int rays, float local[3]) {
  const auto random = [](std::uint32_t key, std::uint32_t counter)
                          HWY_ATTR { return hn::GetLane(unit_float(hash(hn::Set(kU, key), counter))); };
  constexpr float kGolden = 0.618033989f, kTwoPi = 6.28318531f;
  const auto place = static_cast<float>(kOcclusionStrata * ray + block.stratum);
  const float area = (place + random(block.random, 1)) / static_cast<float>(kOcclusionStrata * rays);
  const float turn = random(block.group, 2) + kGolden * place;
  const float radius = std::sqrt(area);
  local[0] = radius * std::cos(kTwoPi * turn);
  local[1] = radius * std::sin(kTwoPi * turn);
  local[2] = std::sqrt(std::max(0.0f, 1.0f - area));
}

// Which stratum a block has changes from frame to frame, so that each block sees all directions in time.
HWY_INLINE OcclusionBlock occlusion_block(const TileJob& job, std::size_t packet) {
  const int column = job.scratch->packet_x[packet] / 4, row = job.scratch->packet_y[packet] / 4;
  const std::uint32_t frame = job.grid->key;
  const auto key_of = [frame](int x, int y, std::uint32_t spread) {
    return frame ^ ((static_cast<std::uint32_t>(y << 16) | static_cast<std::uint32_t>(x)) * spread);
  };
  const float first = hn::GetLane(unit_float(hash(hn::Set(kU, frame), 3)));
  const int place = column % 3 + 3 * (row % 3);
  OcclusionBlock block;
  block.random = key_of(column, row, 0x9e3779b9u);
  block.group = key_of(column / 3, row / 3, 0x85ebca6bu);
  block.stratum = (place + static_cast<int>(kOcclusionStrata * first)) % kOcclusionStrata;
  return block;
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
    float local[3];
    local_direction(occlusion_block(job, static_cast<std::size_t>(p)), ray, job.shading->occlusion_rays,
                    local);
    const V3 n = load3(hits.normal, slot);
    const V3 g = load3(hits.geometric_normal, slot);
    const V3 direction = from_local(n, local);
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
