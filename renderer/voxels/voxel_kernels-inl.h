// Embree's callbacks for grids of voxels: where rays meet them. Compiled once for each instruction set
// (simd/kernel_instance.cpp.in).
#pragma once

#include <cstring>

#include "renderer/voxels/voxel_geometry.h"
#include "renderer/voxels/voxel_traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// The first `count` lanes of values that may end there, zero beyond.
HWY_INLINE VF some_lanes(const float* values, unsigned count) {
  if (count >= static_cast<unsigned>(kLanes)) return hn::LoadU(kF, values);
  alignas(64) float all[kLanes] = {};
  std::memcpy(all, values, count * sizeof(float));
  return hn::Load(kF, all);
}

// Lanes [first, first + lanes) of a packet of N rays, whose fields lie one after the other: origin, tnear,
// direction, time, tfar, mask, id, flags.
class PacketRays {
 public:
  HWY_INLINE PacketRays(RTCRayN* rays, unsigned n, unsigned first)
      : fields_(reinterpret_cast<float*>(rays) + first), n_(n), lanes_(n - first) {}

  HWY_INLINE VF origin(int axis) const { return field(static_cast<unsigned>(axis)); }
  HWY_INLINE VF direction(int axis) const { return field(4 + static_cast<unsigned>(axis)); }
  HWY_INLINE VF tnear() const { return field(3); }
  HWY_INLINE VF tfar() const { return field(8); }
  // In place of a time: random bits (tiles/ray_packets-inl.h).
  HWY_INLINE VU chance() const { return hn::BitCast(kU, field(7)); }
  HWY_INLINE VU id() const { return hn::BitCast(kU, field(10)); }
  HWY_INLINE void set_tfar(MF lanes, VF t) const { store(8, lanes, t); }

  HWY_INLINE VF field(unsigned index) const { return some_lanes(fields_ + index * n_, lanes_); }
  HWY_INLINE void store(unsigned index, MF lanes, VF value) const {
    float* to = fields_ + index * n_;
    if (lanes_ >= static_cast<unsigned>(kLanes))
      return hn::StoreU(hn::IfThenElse(lanes, value, hn::LoadU(kF, to)), kF, to);
    alignas(64) float all[kLanes];
    hn::Store(hn::IfThenElse(lanes, value, some_lanes(to, lanes_)), kF, all);
    std::memcpy(to, all, lanes_ * sizeof(float));
  }

 private:
  float* fields_;
  unsigned n_, lanes_;
};

HWY_INLINE MF valid_lanes(const int* valid, unsigned n, unsigned first) {
  const VF words = some_lanes(reinterpret_cast<const float*>(valid + first), n - first);
  return hn::RebindMask(kF, hn::Ne(hn::BitCast(kI, words), hn::Zero(kI)));
}

HWY_INLINE VoxelRays rays_of(const PacketRays& packet) {
  VoxelRays rays;
  rays.origin = {packet.origin(0), packet.origin(1), packet.origin(2)};
  rays.direction = {packet.direction(0), packet.direction(1), packet.direction(2)};
  rays.tnear = packet.tnear();
  rays.tfar = packet.tfar();
  const VF length = hn::Sqrt(dot(rays.direction, rays.direction));
  const VU footprint = packet.id();
  rays.width = hn::Mul(footprint_width(footprint), length);
  rays.growth = hn::Mul(footprint_growth(footprint), length);
  return rays;
}

// Of the rays that meet something, those that meet it for good: a share equal to the coverage, decided by the
// ray's random bits and the instance.
HWY_INLINE MF decide(const PacketRays& packet, VF passes, MF meets, unsigned instance) {
  if (hn::AllTrue(kF, hn::Or(hn::Not(meets), hn::Eq(passes, hn::Zero(kF))))) return meets;
  return hn::And(meets, hn::Ge(unit_float(hash(packet.chance(), instance)), passes));
}

// Three times 10 bits: square roots, so that dark colours keep their steps.
HWY_INLINE VU packed_colour(const VoxelHits& hits) {
  const VF share = hn::Sub(set(1.0f), hits.passes);
  const VF scale = hn::Div(set(1.0f), hn::Max(share, set(1e-6f)));
  const auto channel = [&](VF sum) HWY_ATTR {
    const VF root = hn::Sqrt(hn::Min(hn::Mul(sum, scale), set(1.0f)));
    return hn::BitCast(kU, hn::ConvertTo(kI, hn::MulAdd(root, set(1023.0f), set(0.5f))));
  };
  return hn::Or(channel(hits.r),
                hn::Or(hn::ShiftLeft<10>(channel(hits.g)), hn::ShiftLeft<20>(channel(hits.b))));
}

// Fields of hits follow those of rays: Ng, u, v, primID, geomID, instID.
constexpr unsigned kRayFields = 12;

void intersect_voxels(const RTCIntersectFunctionNArguments* args) {
  const auto& grid = *static_cast<const VoxelView*>(args->geometryUserPtr);
  const unsigned instance = args->context->instID[0];
  for (unsigned first = 0; first < args->N; first += static_cast<unsigned>(kLanes)) {
    const MF valid = valid_lanes(args->valid, args->N, first);
    const PacketRays packet(reinterpret_cast<RTCRayN*>(args->rayhit), args->N, first);
    const VoxelRays rays = rays_of(packet);
    VoxelHits hits;
    MF meets = VoxelMarch(grid, rays).run<true>(valid, hits);
    if (hn::AllFalse(kF, meets)) continue;
    meets = hn::And(valid, decide(packet, hits.passes, meets, instance));
    if (hn::AllFalse(kF, meets)) continue;
    packet.set_tfar(meets, hits.t);
    const auto face = [&](int axis, VF d) HWY_ATTR {
      const VF outwards = hn::CopySign(set(1.0f), hn::Neg(d));
      return hn::IfThenElseZero(hn::RebindMask(kF, hn::Eq(hits.axis, hn::Set(kI, axis))), outwards);
    };
    packet.store(kRayFields + 0, meets, face(0, rays.direction.x));
    packet.store(kRayFields + 1, meets, face(1, rays.direction.y));
    packet.store(kRayFields + 2, meets, face(2, rays.direction.z));
    packet.store(kRayFields + 3, meets, hn::BitCast(kF, packed_colour(hits)));
    packet.store(kRayFields + 4, meets, hn::Zero(kF));
    packet.store(kRayFields + 5, meets, hn::BitCast(kF, hn::Set(kU, args->primID)));
    packet.store(kRayFields + 6, meets, hn::BitCast(kF, hn::Set(kU, args->geomID)));
    packet.store(kRayFields + 7, meets, hn::BitCast(kF, hn::Set(kU, instance)));
  }
}

void occlude_voxels(const RTCOccludedFunctionNArguments* args) {
  const auto& grid = *static_cast<const VoxelView*>(args->geometryUserPtr);
  for (unsigned first = 0; first < args->N; first += static_cast<unsigned>(kLanes)) {
    const MF valid = valid_lanes(args->valid, args->N, first);
    const PacketRays packet(args->ray, args->N, first);
    const VoxelRays rays = rays_of(packet);
    VoxelHits hits;
    MF meets = VoxelMarch(grid, rays).run<false>(valid, hits);
    if (hn::AllFalse(kF, meets)) continue;
    meets = hn::And(valid, decide(packet, hits.passes, meets, args->context->instID[0]));
    packet.set_tfar(meets, hn::Neg(hn::Inf(kF)));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
