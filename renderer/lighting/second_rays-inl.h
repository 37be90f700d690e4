// What reflections and refractions share: tracing a queue of second rays, lighting what they hit, and adding
// its light to the hits that sent them. Rays are compacted into dense packets.
#pragma once

#include <cstring>

#include "renderer/direct_light/direct_light-inl.h"
#include "renderer/environment/environment-inl.h"
#include "renderer/lighting/catcher_ratio-inl.h"
#include "renderer/lighting/mirrored_feed-inl.h"
#include "renderer/lighting/outgoing-inl.h"
#include "renderer/lighting/probe_lookup-inl.h"
#include "renderer/reflectance/gloss-inl.h"
#include "renderer/reflectance/interfaces-inl.h"
#include "renderer/surfaces/surfaces-inl.h"
#include "renderer/tiles/finite_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// A second ray whose weight is below half an 8-bit step of white in every channel cannot be seen: it is not
// traced. What is left out is below this times the radiance that the ray would have brought.
constexpr float kNegligibleWeight = 1.0f / 512.0f;

// The way of a ray since its first hit, where there is glass: the sender, whether an opaque mirror lies on
// the way, and a code of which way light took at each surface, with a leading 1. Its random numbers depend on
// it.
constexpr int kSenderBits = 10;
static_assert(1 << kSenderBits == kTileRays);
constexpr std::int32_t kMirroredPath = 1 << kSenderBits;
constexpr std::int32_t kFirstCode = kMirroredPath << 1;
constexpr std::int32_t kLastPath = kFirstCode << kMostInterfaces;  // codes from here on have no room for more
static_assert(kMostInterfaces < 19);

HWY_INLINE std::int32_t sender_of(std::int32_t path) {
  return path & (kMirroredPath - 1);
}
HWY_INLINE VI path_through(VI path) {
  return hn::Add(path, hn::AndNot(hn::Set(kI, kFirstCode - 1), path));
}
HWY_INLINE VI path_back(VI path) {
  return hn::Add(path_through(path), hn::Set(kI, kFirstCode));
}

// Sets out on a pass of second rays: those of the queue, each remembered with its sender.
HWY_INLINE void remember_senders(TileScratch& scratch) {
  std::memcpy(scratch.second->sender.data(), scratch.queue.hit.data(),
              sizeof(std::int32_t) * static_cast<std::size_t>(scratch.queue.count));
}

// Traces the queued rays and stores their surfaces in the second batch, slot i for ray i. `salt` tells the
// random numbers of this pass from those of others; those that follow `glass` also depend on the path.
template <SurfaceDetail kDetail>
HWY_NOINLINE void trace_second_rays(const TileJob& job, RayKind kind, std::uint32_t salt,
                                    bool glass = false) {
  TileScratch& scratch = *job.scratch;
  SecondRays& second = *scratch.second;
  const RayQueue& queue = scratch.queue;
  RayHit& packet = packets_of(scratch)[0];  // the first hits are done with
  alignas(64) int valid[kMaxLanes];
  for (int start = 0; start < queue.count; start += kLanes) {
    const MF used = first_lanes(queue.count - start);
    const V3 origin = load3(queue.origin, start);
    const V3 direction = load3(queue.direction, start);
    const MF lanes = hn::And(used, traceable(origin, direction));
    job.counters->rays[kind] += static_cast<std::int64_t>(hn::CountTrue(kF, lanes));
    job.counters->invalid_rays +=
        static_cast<std::int64_t>(hn::CountTrue(kF, used) - hn::CountTrue(kF, lanes));
    set_rays(packet, origin, direction);
    const VI sender = hn::IfThenElseZero(hn::RebindMask(kI, used), hn::LoadU(kI, &second.sender[start]));
    const auto sent_by = [&](const Lane<float>& from)
                             HWY_ATTR { return hn::GatherIndex(kF, from.data(), sender); };
    // What follows glass is as wide where it starts as the ray before was there.
    const VF width = glass ? hn::IfThenElseZero(used, load(&second.hits.cone_width[start]))
                           : sent_by(scratch.first.cone_width);
    VF spread = sent_by(scratch.first.cone_spread);
    // Thin glass and flat mirrors widen nothing. Over the ray's width a curved mirror's normal turns by width
    // x curvature, and what it reflects by twice that.
    if (kind == RayKind::mirror) {
      spread = hn::MulAdd(hn::Add(width, width), sent_by(scratch.first.curvature), spread);
    }
    hn::Store(width, kF, &second.hits.cone_width[start]);
    hn::Store(spread, kF, &second.hits.cone_spread[start]);
    if (kDetail != SurfaceDetail::plain) widen(packet.ray, second.hits, start);
    VU key = hn::BitCast(
        kU, hn::GatherIndex(kI, reinterpret_cast<const std::int32_t*>(scratch.first.key.data()), sender));
    if (glass) {
      const VU path = hn::BitCast(kU, hn::Load(kI, &second.path[start]));
      key = hn::Xor(key, hn::Mul(hn::ShiftRight<kSenderBits + 1>(path), hn::Set(kU, 0x9e3779b1u)));
    }
    key = hash(key, salt);
    hn::Store(key, kU, &second.hits.key[start]);
    if (job.shading->plan->voxels) set_chance(packet.ray, key);
    hn::Store(hn::Set(kU, kSecondLook), kU, packet.ray.flags);
    set_valid(valid, lanes);
    record(job, kind, packet.ray, valid, false);
    intersect_packet<kLanes>(valid, job.shading->scene, !glass, &packet);
    surface_of_packet<kDetail>(packet, lanes, *job.shading, true, second.hits, start);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(queue.count); ++i) {
    const auto sender = static_cast<std::size_t>(second.sender[i]);
    second.hits.block[i] = scratch.first.block[sender];
    second.hits.rank[i] = scratch.first.rank[sender];
  }
  if (job.grid->feed != nullptr) show_feed(job, queue.count);
}

// With probes: what second hits [0, rays) receive from other surfaces.
HWY_INLINE void light_indirectly(const TileJob& job, int rays) {
  if (job.shading->probes == nullptr) return;
  job.cycles->lap(Stage::second_light);
  indirect_light(job, job.scratch->second->hits, rays);
  job.cycles->lap(Stage::indirect_light);
}

// Adds what second rays [0, rays) brought to the light of the first hits that sent them: objects to
// all, what is not virtual to objects only, since a catcher's feed shows the real room already. Rays of
// kind none bring nothing. `onward`: the hits' mirrored light was followed (HitBatch::mirror says how much).
// `mirrored`: the first hits sent these rays themselves; where one leaves the scene, a surface that reflects
// by its roughness shows the environment as its lobe does.
HWY_NOINLINE inline void gather_second_light(const TileJob& job, int rays, bool onward, bool mirrored) {
  HitBatch& first = job.scratch->first;
  const SecondRays& sent = *job.scratch->second;
  const HitBatch& second = sent.hits;
  const bool blurs = mirrored && job.shading->plan->filtered_environment && job.grid->feed == nullptr;
  alignas(64) float r[kMaxLanes], g[kMaxLanes], b[kMaxLanes];
  for (int start = 0; start < rays; start += kLanes) {
    const MF object = of_kind(second, start, HitKind::object), miss = of_kind(second, start, HitKind::miss);
    V3 radiance = outgoing(second, start, *job.shading, onward, false);
    MF brings = hn::Or(object, miss);
    if (job.grid->feed != nullptr) {
      const MF catcher = of_kind(second, start, HitKind::catcher);
      V3 feed = load3(sent.feed->radiance, start);
      if (!hn::AllFalse(kF, catcher)) {
        const CatcherLight at = catcher_light(*job.shading, second, start, false, false);
        feed = select(catcher, add(multiply(feed, at.ratio), at.added), feed);
      }
      radiance = select(object, radiance, feed);
      brings = hn::Or(brings, catcher);
    } else if (!hn::AllFalse(kF, miss)) {
      const V3 back = load3(second.viewer, start);
      radiance = select(object, radiance, environment_radiance(*job.shading, scale(back, set(-1.0f))));
    }
    hn::Store(hn::IfThenElseZero(brings, radiance.x), kF, r);
    hn::Store(hn::IfThenElseZero(brings, radiance.y), kF, g);
    hn::Store(hn::IfThenElseZero(brings, radiance.z), kF, b);
    const int lanes = rays - start < kLanes ? rays - start : kLanes;
    for (int i = 0; i < lanes; ++i) {
      const auto ray = static_cast<std::size_t>(start + i);
      const auto hit = static_cast<std::size_t>(sent.sender[ray]);
      if (first.kind[hit] == static_cast<int>(HitKind::catcher)) {
        if (second.kind[ray] != static_cast<int>(HitKind::object) || second.is_catcher[ray] != 0) continue;
        first.mirrored.x[hit] += sent.weight.x[ray] * r[i];
        first.mirrored.y[hit] += sent.weight.y[ray] * g[i];
        first.mirrored.z[hit] += sent.weight.z[ray] * b[i];
      } else if (blurs && first.gloss->own[hit] > 0 && second.kind[ray] == static_cast<int>(HitKind::miss)) {
        first.direct.x[hit] += first.mirror[hit] * first.gloss->shine.x[hit];
        first.direct.y[hit] += first.mirror[hit] * first.gloss->shine.y[hit];
        first.direct.z[hit] += first.mirror[hit] * first.gloss->shine.z[hit];
      } else {
        first.direct.x[hit] += sent.weight.x[ray] * r[i];
        first.direct.y[hit] += sent.weight.y[ray] * g[i];
        first.direct.z[hit] += sent.weight.z[ray] * b[i];
      }
    }
  }
}

// Lights what second rays [0, rays) met, just traced, and adds what they bring. The rest of their stages.
template <Lobe kLobe>
HWY_INLINE void bring_second_light(const TileJob& job, int rays, RayKind shadow, bool onward) {
  const HitBatch& hits = job.scratch->second->hits;
  job.cycles->lap(Stage::second_hits);
  require_finite(hits, rays, Stage::second_hits, *job.shading->plan);
  direct_light<kLobe>(job, job.scratch->second->hits, rays, shadow);
  require_finite(hits, rays, Stage::light_rays, *job.shading->plan);
  light_indirectly(job, rays);
  if (job.shading->plan->filtered_environment) {
    show_environment(*job.shading, job.scratch->second->hits, rays);
  }
  require_finite(hits, rays, Stage::indirect_light, *job.shading->plan);
  gather_second_light(job, rays, onward, shadow == RayKind::mirror_shadow);
  job.cycles->lap(Stage::second_light);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
