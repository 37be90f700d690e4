// Rays -> Embree packets, the same way for every kind of ray, and their copies for bench's recorder.
// A lane that is not valid may hold anything: Embree never looks at it.
#pragma once

#include <limits>

#include "renderer/embree/footprint-inl.h"
#include "renderer/embree/ray_packet-inl.h"
#include "renderer/simd/simd_types-inl.h"
#include "renderer/tiles/tile_job.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

constexpr float kEndless = std::numeric_limits<float>::infinity();

HWY_INLINE RayHit* packets_of(TileScratch& scratch) {
  return reinterpret_cast<RayHit*>(scratch.packets);
}

// Rays from t = 0 to `end` that see geometry of `mask`.
HWY_INLINE void set_rays(Ray& packet, const V3& origin, const V3& direction, float end, unsigned mask) {
  hn::Store(origin.x, kF, packet.org_x);
  hn::Store(origin.y, kF, packet.org_y);
  hn::Store(origin.z, kF, packet.org_z);
  hn::Store(direction.x, kF, packet.dir_x);
  hn::Store(direction.y, kF, packet.dir_y);
  hn::Store(direction.z, kF, packet.dir_z);
  hn::Store(hn::Zero(kF), kF, packet.tnear);
  hn::Store(set(end), kF, packet.tfar);
  hn::Store(hn::Zero(kF), kF, packet.time);
  hn::Store(hn::Set(kU, mask), kU, packet.mask);
  hn::Store(hn::Zero(kU), kU, packet.flags);
  hn::Store(hn::Zero(kU), kU, packet.id);
}

// Writes into the rays how wide they are, for hit filters and voxels.
HWY_INLINE void widen(Ray& packet, const HitBatch& hits, int slot) {
  const VF zero = hn::Zero(kF);
  hn::Store(footprint_code(hn::Max(load(&hits.cone_width[slot]), zero),
                           hn::Max(load(&hits.cone_spread[slot]), zero)),
            kU, packet.id);
}

// Random bits that decide whether rays meet what hides a share of them: voxels. They travel in the rays'
// time, which nothing else asks for. They come from the sample that sends the rays, not from where those
// lead, so that rounding decides nothing.
HWY_INLINE void set_chance(Ray& packet, VU key) {
  hn::Store(unit_float(key), kF, packet.time);
}

// Rays that look for the nearest hit.
HWY_INLINE void set_rays(RayHit& packet, const V3& origin, const V3& direction) {
  set_rays(packet.ray, origin, direction, kEndless, kAllMask);
  hn::Store(hn::Set(kU, RTC_INVALID_GEOMETRY_ID), kU, packet.hit.geomID);
  hn::Store(hn::Set(kU, RTC_INVALID_GEOMETRY_ID), kU, packet.hit.instID[0]);
}

HWY_INLINE void set_valid(int* valid, MF lanes) {
  hn::Store(hn::VecFromMask(kI, hn::RebindMask(kI, lanes)), kI, valid);
}

HWY_NOINLINE inline void record_in(RayRecorder& recorder, RayKind kind, const Ray& packet, const int* valid,
                                   bool gaps) {
  for (int i = 0; i < kLanes; ++i) {
    if (valid[i] != 0) {
      recorder.add(kind, packet.org_x[i], packet.org_y[i], packet.org_z[i], packet.dir_x[i], packet.dir_y[i],
                   packet.dir_z[i], packet.id[i], packet.time[i]);
    } else if (gaps) {
      recorder.add_gap(kind);
    }
  }
}
// Copies a packet's rays to the recorder, if there is one; `gaps` keeps idle lanes as gaps.
HWY_INLINE void record(const TileJob& job, RayKind kind, const Ray& packet, const int* valid, bool gaps) {
  if (job.recorder) record_in(*job.recorder, kind, packet, valid, gaps);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
