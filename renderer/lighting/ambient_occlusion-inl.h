// Stage: ambient occlusion. A few short rays per hit, cosine-weighted about the normal; the share that meets
// nothing within the radius multiplies indirect light. All hits of a 4x4 block of samples turn the same local
// directions into their own frames: rays of a packet then stay together, which makes them twice as fast as
// directions of their own, at the price of noise that is the same over the block.
#pragma once

#include <cmath>

#include "renderer/lighting/direct_light-inl.h"

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

// Direction `ray` of `rays`, cosine-distributed (Malley's method): radii stratified, angles by the golden
// ratio, both shifted by random numbers of the block.
HWY_INLINE void local_direction(std::uint32_t key, int ray, int rays, float local[3]) {
  const auto random = [&](std::uint32_t counter) {
    return hn::GetLane(unit_float(hash(hn::Set(kU, key), counter)));
  };
  constexpr float kGolden = 0.618033989f, kTwoPi = 6.28318531f;
  const float area = (static_cast<float>(ray) + random(1)) / static_cast<float>(rays);
  const float turn = random(2) + kGolden * static_cast<float>(ray);
  const float radius = std::sqrt(area);
  local[0] = radius * std::cos(kTwoPi * turn);
  local[1] = radius * std::sin(kTwoPi * turn);
  local[2] = std::sqrt(std::max(0.0f, 1.0f - area));
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
    const auto i = static_cast<std::size_t>(p);
    const auto block = static_cast<std::uint32_t>((scratch.packet_y[i] & ~3) << 16 | scratch.packet_x[i]);
    float local[3];
    local_direction(job.grid->key ^ (block * 0x9e3779b9u), ray, job.shading->occlusion_rays, local);
    const V3 n = load3(hits.normal, slot);
    const V3 g = load3(hits.geometric_normal, slot);
    const V3 direction = from_local(n, local);
    const MF above = hn::And(surface, hn::Gt(dot(direction, g), hn::Zero(kF)));
    push(scratch.queue, ray_origin(hits, slot), scale(direction, radius), hn::Add(lane, hn::Set(kI, slot)),
         above);
  }
}

// Fills HitBatch::open and open_without of the first hits.
HWY_NOINLINE inline void ambient_occlusion(const TileJob& job, int packets) {
  TileScratch& scratch = *job.scratch;
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
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
