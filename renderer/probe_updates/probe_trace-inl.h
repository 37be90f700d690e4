// The rays of a frame's probes: each job's 16 neighbours look in the same directions, one packet a direction,
// and what they hit is lit like any surface, by the lights and by last frame's probes.
// Compiled once for each instruction set (simd/kernel_instance.cpp.in).
#pragma once

#include <cmath>

#include "renderer/direct_light/direct_light-inl.h"
#include "renderer/environment/environment-inl.h"
#include "renderer/lighting/probe_lookup-inl.h"
#include "renderer/probe_updates/probe_job.h"
#include "renderer/probe_updates/probe_update-inl.h"
#include "renderer/surfaces/surfaces-inl.h"
#include "renderer/tiles/finite_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

constexpr int kRaysAtOnce = kTileRays / kProbeLanes;

// Where the job's probes stand, metres from the anchor.
struct ProbeOrigins {
  alignas(64) float x[kProbeLanes] = {}, y[kProbeLanes] = {}, z[kProbeLanes] = {};
  alignas(64) std::uint32_t probe[kProbeLanes] = {};
};

HWY_INLINE ProbeOrigins probe_origins(const ProbeJob& job) {
  const ProbeView& view = *job.tile.shading->probes;
  ProbeOrigins origins;
  int lane = 0;
  for (const std::int32_t probe : job.volume->job_probes(job.job)) {
    const float* place = view.places + 4 * static_cast<std::size_t>(probe);
    origins.x[lane] = view.lower[0] + place[0];
    origins.y[lane] = view.lower[1] + place[1];
    origins.z[lane] = view.lower[2] + place[2];
    origins.probe[lane] = static_cast<std::uint32_t>(probe);
    ++lane;
  }
  return origins;
}

// Traces rays [first, first + rays) of every probe; slot 16 r + p holds ray first + r of probe p.
template <SurfaceDetail kDetail>
HWY_INLINE void trace_directions(const ProbeJob& job, const ProbeOrigins& origins, int first, int rays) {
  const TileJob& tile = job.tile;
  HitBatch& hits = tile.scratch->first;
  const ProbeDirections& directions = job.volume->directions;
  const unsigned mask = job.volume->sets[static_cast<std::size_t>(job.set)].mask;
  const int probes = static_cast<int>(job.volume->job_probes(job.job).size());
  RayHit& packet = packets_of(*tile.scratch)[0];
  const RayKind kind = job.set == 0 ? RayKind::probe : RayKind::catcher_probe;
  alignas(64) int valid[kMaxLanes];
  for (int slot = 0; slot < rays * kProbeLanes; slot += kLanes) {
    const auto ray = static_cast<std::size_t>(first + slot / kProbeLanes);
    const int lane = slot % kProbeLanes;
    const V3 origin = load3(origins.x + lane, origins.y + lane, origins.z + lane);
    const V3 direction{set(directions.x[ray]), set(directions.y[ray]), set(directions.z[ray])};
    const MF lanes = hn::And(first_lanes(probes - lane), traceable(origin, direction));
    set_rays(packet, origin, direction);
    hn::Store(hn::Set(kU, mask), kU, packet.ray.mask);
    const VU key = hash(hn::Xor(hn::Load(kU, origins.probe + lane), hn::Set(kU, directions.key)),
                        static_cast<std::uint32_t>(ray));
    hn::Store(key, kU, &hits.key[slot]);
    if (tile.shading->plan->voxels) set_chance(packet.ray, key);
    set_valid(valid, lanes);
    tile.counters->rays[kind] += static_cast<std::int64_t>(hn::CountTrue(kF, lanes));
    hn::Store(hn::Set(kU, kSecondLook), kU, packet.ray.flags);
    // A cone of the solid angle that each ray stands for, as wide as it is high.
    const float spread = std::sqrt(12.5663706f / static_cast<float>(job.volume->directions.rays()));
    hn::Store(hn::Zero(kF), kF, &hits.cone_width[slot]);
    hn::Store(set(spread), kF, &hits.cone_spread[slot]);
    if constexpr (kDetail != SurfaceDetail::plain) widen(packet.ray, hits, slot);
    record(tile, kind, packet.ray, valid, true);
    if (!hn::AllFalse(kF, lanes)) intersect_packet<kLanes>(valid, tile.shading->scene, false, &packet);
    surface_of_packet<kDetail>(packet, lanes, *tile.shading, true, hits, slot, SurfaceUse::matte);
  }
}

// 0 for what is not finite, within the range that look-ups can add up.
HWY_INLINE VF sound(VF value, MF& bad) {
  const MF finite = hn::Le(hn::Abs(value), set(3e38f));
  bad = hn::Or(bad, hn::Not(finite));
  return hn::IfThenElseZero(finite, hn::Min(hn::Max(value, hn::Zero(kF)), set(kLargestHalf)));
}

// Light that hits [0, 16 rays) send back to the probes.
HWY_INLINE void store_radiance(const ProbeJob& job, int first, int rays) {
  const HitBatch& hits = job.tile.scratch->first;
  const ProbeDirections& directions = job.volume->directions;
  const int probes = static_cast<int>(job.volume->job_probes(job.job).size());
  for (int slot = 0; slot < rays * kProbeLanes; slot += kLanes) {
    const MF object = of_kind(hits, slot, HitKind::object);
    const auto channel = [&](const Lane<float>& emission, const Lane<float>& diffuse,
                             const Lane<float>& direct, const Lane<float>& indirect) HWY_ATTR {
      return hn::Add(load(&emission[slot]),
                     hn::MulAdd(load(&diffuse[slot]), load(&indirect[slot]), load(&direct[slot])));
    };
    const auto ray = static_cast<std::size_t>(first + slot / kProbeLanes);
    const V3 direction{set(directions.x[ray]), set(directions.y[ray]), set(directions.z[ray])};
    const ShadingInputs& shading = *job.tile.shading;
    const V3 environment = shading.filtered.coarse.texels != nullptr
                               ? environment_texel(shading.filtered.coarse, direction)
                               : environment_radiance(shading, direction);
    V3 light = select(object,
                      {channel(hits.emission.x, hits.diffuse.x, hits.direct.x, hits.indirect.x),
                       channel(hits.emission.y, hits.diffuse.y, hits.direct.y, hits.indirect.y),
                       channel(hits.emission.z, hits.diffuse.z, hits.direct.z, hits.indirect.z)},
                      environment);
    MF bad = first_lanes(0);
    light = {sound(light.x, bad), sound(light.y, bad), sound(light.z, bad)};
    bad = hn::And(bad, first_lanes(probes - slot % kProbeLanes));
    job.tile.counters->nonfinite_values += static_cast<std::int64_t>(hn::CountTrue(kF, bad));
    ProbeLanes* to = job.radiance + kProbeRayLanes * ray;
    const int lane = slot % kProbeLanes;
    hn::Store(light.x, kF, to[0].of_probe + lane);
    hn::Store(light.y, kF, to[1].of_probe + lane);
    hn::Store(light.z, kF, to[2].of_probe + lane);
    hn::Store(hn::IfThenElseZero(of_kind(hits, slot, HitKind::miss), set(1.0f)), kF, to[3].of_probe + lane);
  }
}

void trace_probes(const ProbeJob& job) {
  const TileJob& tile = job.tile;
  HitBatch& hits = tile.scratch->first;
  const ProbeOrigins origins = probe_origins(job);
  const int all = job.volume->directions.rays();
  for (int first = 0; first < all; first += kRaysAtOnce) {
    const int rays = all - first < kRaysAtOnce ? all - first : kRaysAtOnce;
    const int count = rays * kProbeLanes;
    if (tile.shading->plan->surface_details) {
      trace_directions<SurfaceDetail::all>(job, origins, first, rays);
    } else if (tile.shading->plan->textures || tile.shading->plan->voxels) {
      trace_directions<SurfaceDetail::textures>(job, origins, first, rays);
    } else {
      trace_directions<SurfaceDetail::plain>(job, origins, first, rays);
    }
    require_finite(hits, count, Stage::probe_rays, *tile.shading->plan);
    direct_light<Lobe::none>(tile, hits, count,
                             job.set == 0 ? RayKind::probe_shadow : RayKind::catcher_probe_shadow);
    require_finite(hits, count, Stage::light_rays, *tile.shading->plan);
    indirect_light(tile, hits, count);
    require_finite(hits, count, Stage::indirect_light, *tile.shading->plan);
    store_radiance(job, first, rays);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
