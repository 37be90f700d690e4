// Vectors of a batch's lanes <-> registers: kLanes hits from `slot` on, a multiple of kLanes unless stated.
#pragma once

#include <cstring>

#include "renderer/simd/simd_types-inl.h"
#include "renderer/tiles/tile_job.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

HWY_INLINE V3 load3(const Lane3& lanes, int slot) {
  return {load(&lanes.x[slot]), load(&lanes.y[slot]), load(&lanes.z[slot])};
}
HWY_INLINE void store3(const V3& value, Lane3& lanes, int slot) {
  hn::Store(value.x, kF, &lanes.x[slot]);
  hn::Store(value.y, kF, &lanes.y[slot]);
  hn::Store(value.z, kF, &lanes.z[slot]);
}
// Stores the hits of `mask` and keeps the others.
HWY_INLINE void store_lanes(const V3& value, MF mask, Lane3& lanes, int slot) {
  store_lanes(value.x, mask, &lanes.x[slot]);
  store_lanes(value.y, mask, &lanes.y[slot]);
  store_lanes(value.z, mask, &lanes.z[slot]);
}

HWY_INLINE void add_to(Lane<float>& lane, int slot, VF value) {
  hn::Store(hn::Add(load(&lane[slot]), value), kF, &lane[slot]);
}
HWY_INLINE void add_to(Lane3& lanes, int slot, const V3& value) {
  add_to(lanes.x, slot, value.x);
  add_to(lanes.y, slot, value.y);
  add_to(lanes.z, slot, value.z);
}

// Zeroes hits [0, count), whole vectors of them.
HWY_INLINE void clear(Lane<float>& lane, int count) {
  std::memset(lane.data(), 0,
              sizeof(float) * static_cast<std::size_t>((count + kLanes - 1) / kLanes * kLanes));
}
HWY_INLINE void clear(Lane3& lanes, int count) {
  clear(lanes.x, count);
  clear(lanes.y, count);
  clear(lanes.z, count);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
