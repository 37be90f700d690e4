// Takes rays from the queue of those that follow light through glass, a batch at a time, until none is left:
// traces them, sends their light onward, and adds what the others bring. Before: onward_rays. After:
// reflections, refractions.
#pragma once

#include "renderer/lighting/onward_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Rays that first hits send by reflection have one surface behind them.
HWY_NOINLINE inline void remember_mirror_paths(TileScratch& scratch, int rays) {
  SecondRays& second = *scratch.second;
  const HitBatch& first = scratch.first;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rays); ++i) {
    const auto hit = static_cast<std::size_t>(second.sender[i]);
    const bool glass = first.kind[hit] == static_cast<int>(HitKind::object) && first.transmission[hit] > 0;
    second.path[i] = second.sender[i] + (glass ? 0 : kMirroredPath) + 3 * kFirstCode;
    const bool inside = glass && first.index_ratio[hit] > 1;
    second.medium.x[i] = inside ? first.absorption.x[hit] : 0.0f;
    second.medium.y[i] = inside ? first.absorption.y[hit] : 0.0f;
    second.medium.z[i] = inside ? first.absorption.z[hit] : 0.0f;
  }
}

// Copies the first `rays` that wait into the queue of those in work.
HWY_NOINLINE inline void take_pending(TileScratch& scratch, int rays) {
  SecondRays& second = *scratch.second;
  PendingRays& pending = *second.pending;
  const auto from = static_cast<std::size_t>(pending.begin);
  pending.begin += rays;
  pending.budget -= rays;
  scratch.queue.count = rays;
  const auto take = [&](const PendingRays::Queue3& part, Lane3& to) {
    const std::size_t bytes = sizeof(float) * static_cast<std::size_t>(rays);
    std::memcpy(to.x.data(), part.x.data() + from, bytes);
    std::memcpy(to.y.data(), part.y.data() + from, bytes);
    std::memcpy(to.z.data(), part.z.data() + from, bytes);
  };
  take(pending.origin, scratch.queue.origin);
  take(pending.direction, scratch.queue.direction);
  take(pending.weight, second.weight);
  take(pending.medium, second.medium);
  std::memcpy(second.hits.cone_width.data(), pending.width.data() + from,
              sizeof(float) * static_cast<std::size_t>(rays));
  for (std::size_t i = 0; i < static_cast<std::size_t>(rays); ++i) {
    second.path[i] = pending.path[from + i];
    second.sender[i] = sender_of(second.path[i]);
  }
}

// Ends all paths that wait: the frame has no time for more of them.
HWY_NOINLINE inline void end_pending(const TileJob& job) {
  PendingRays& pending = *job.scratch->second->pending;
  for (int start = pending.begin; start < pending.end; start += kLanes) {
    const auto load_unaligned = [&](const PendingRays::Queue3& from) HWY_ATTR -> V3 {
      return {loadu(from.x.data() + start), loadu(from.y.data() + start), loadu(from.z.data() + start)};
    };
    const MF lanes = first_lanes(pending.end - start);
    const V3 ahead{set(0.0f), set(0.0f), set(-1.0f)};
    const V3 direction = select(lanes, load_unaligned(pending.direction), ahead);
    end_paths(job, hn::LoadU(kI, pending.path.data() + start), lanes, load_unaligned(pending.weight),
              feed_or(job, load_unaligned(pending.origin), direction, lanes,
                      environment_radiance(*job.shading, direction)));
  }
  pending.begin = pending.end = 0;
}

template <SurfaceDetail kDetail, Lobe kLobe>
HWY_NOINLINE void follow_rays(const TileJob& job) {
  TileScratch& scratch = *job.scratch;
  PendingRays& pending = *scratch.second->pending;
  while (pending.begin < pending.end) {
    const int waiting = pending.end - pending.begin, fit = waiting < kTileRays ? waiting : kTileRays;
    const int rays = fit < pending.budget ? fit : pending.budget;
    if (rays <= 0) {
      end_pending(job);
      break;
    }
    take_pending(scratch, rays);
    trace_second_rays<kDetail>(job, RayKind::refraction, 0x2545f491u, true);
    if (job.shading->plan->gloss) prepare_gloss(*job.shading->plan, scratch.second->hits, rays, true);
    if constexpr (kLobe == Lobe::layered) cover_bases(scratch.second->hits, rays);
    send_onward(job, rays);
    bring_second_light<kLobe>(job, rays, RayKind::refraction_shadow, true);
  }
  pending.begin = pending.end = 0;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
