// Normals of hits, turned to the viewer's side: those of triangles and those that shapes and voxels bring.
// Before: Embree. After: surfaces; normal_texture bends them where a material says so.
#pragma once

#include "renderer/embree/ray_packet-inl.h"
#include "renderer/surfaces/material_at-inl.h"
#include "renderer/tiles/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

HWY_INLINE V3 decode_normal(VU code) {
  const VF to_unit = set(1.0f / 32767.0f);
  const VF x =
      hn::Mul(hn::ConvertTo(kF, hn::ShiftRight<16>(hn::BitCast(kI, hn::ShiftLeft<16>(code)))), to_unit);
  const VF y = hn::Mul(hn::ConvertTo(kF, hn::ShiftRight<16>(hn::BitCast(kI, code))), to_unit);
  const VF z = hn::Sub(set(1.0f), hn::Add(hn::Abs(x), hn::Abs(y)));
  const VF fold = hn::Max(hn::Neg(z), hn::Zero(kF));
  return {hn::Sub(x, hn::CopySign(fold, x)), hn::Sub(y, hn::CopySign(fold, y)), z};
}

HWY_INLINE V3 normal_to_world(const InstanceRecord& instance, const V3& n) {
  const float* m = instance.normal_from_object;
  return normalise(V3{dot(set3(m), n), dot(set3(m + 3), n), dot(set3(m + 6), n)});
}

// Embree's normal has the triangle's area for its length: brought near 1, or a sliver's would underflow.
HWY_INLINE V3 object_normal(const RayHit& packet) {
  const V3 area{load(packet.hit.Ng_x), load(packet.hit.Ng_y), load(packet.hit.Ng_z)};
  const VF largest =
      hn::Max(hn::Max(hn::Abs(area.x), hn::Abs(area.y)), hn::Max(hn::Abs(area.z), set(1e-37f)));
  return scale(area, hn::Div(set(1.0f), largest));
}

// Area in object space of a square metre of the face that is hit. A matrix turns areas by its inverse
// transpose times its volume.
HWY_INLINE VF face_per_world2(const InstanceRecord& instance, const RayHit& packet) {
  if (instance.face_per_world2 == 0 || instance.kind != ShapeKind::mesh)
    return set(instance.object_per_world2);
  const V3 n = object_normal(packet);
  const float* m = instance.normal_from_object;
  const V3 turned{dot(set3(m), n), dot(set3(m + 3), n), dot(set3(m + 6), n)};
  const VF shorter2 = hn::Div(dot(n, n), hn::Max(dot(turned, turned), set(1e-37f)));
  return hn::Mul(set(instance.face_per_world2), hn::Sqrt(shorter2));
}

// Three octahedral codes of each triangle, one for each corner, interpolated: of no special length.
HWY_INLINE V3 interpolate_directions(const std::uint32_t* words, VI record, const Barycentric& at) {
  const V3 a = decode_normal(hn::GatherIndex(kU, words, record)),
           b = decode_normal(hn::GatherIndex(kU, words + 1, record)),
           c = decode_normal(hn::GatherIndex(kU, words + 2, record));
  return mul_add(at.w, a, mul_add(at.u, b, scale(c, at.v)));
}

// `curvature`: in object space. Where a matrix stretches, the mean over directions stands for all of them.
HWY_INLINE void store_curvature(const InstanceRecord& instance, VF curvature, MF lanes, HitBatch& out,
                                int slot) {
  const VF object_per_world = hn::Sqrt(set(instance.object_per_world2));
  store_lanes(hn::Mul(curvature, object_per_world), lanes, out.curvature.data() + slot);
}

// Above 1 exactly where the viewer is `inside`: by a hair where the index itself is 1 (or 0, a mirror).
HWY_INLINE void store_index_ratio(const InstanceRecord& instance, MF inside, MF lanes, HitBatch& out,
                                  int slot) {
  const float index = instance.refractive_index > 1 ? instance.refractive_index : 1.0f + 0x1p-23f;
  store_lanes(hn::IfThenElse(inside, set(index), set(1.0f / index)), lanes, out.index_ratio.data() + slot);
}

// Normals of `lanes`, turned to the viewer's side, and where secondary rays start: at least `rounding` off
// the surface. Returns where the triangle's back is seen: some of `lanes`.
HWY_INLINE MF store_normals(const InstanceRecord& instance, VI record, const Barycentric& at,
                            const RayHit& packet, const V3& viewer, VF rounding, MF lanes, HitBatch& out,
                            int slot) {
  V3 g = normal_to_world(instance, object_normal(packet));
  V3 n = normal_to_world(
      instance,
      interpolate_directions(reinterpret_cast<const std::uint32_t*>(instance.triangles), record, at));
  const MF g_behind = hn::Lt(dot(g, viewer), hn::Zero(kF));
  g = select(g_behind, scale(g, set(-1.0f)), g);
  // Normals of a closed surface point outwards: from behind, the viewer is inside.
  store_index_ratio(instance, g_behind, lanes, out, slot);
  // The shading normal follows the geometric one's side, so that both see the same lights.
  n = select(hn::Lt(dot(n, g), hn::Zero(kF)), scale(n, set(-1.0f)), n);
  // A flat triangle's stored normal is its own but for rounding to 16 bits (6.6e-5 rad at
  // most): glass shows that.
  const V3 bend = sub(n, g);
  n = select(hn::Lt(dot(bend, bend), set(2e-8f)), g, n);
  store_lanes(g, lanes, out.geometric_normal, slot);
  store_lanes(n, lanes, out.normal, slot);
  const VU word = hn::GatherIndex(kU, reinterpret_cast<const std::uint32_t*>(instance.triangles) + 7, record);
  const VU last_bits = hn::Set(kU, 0xffu);
  store_curvature(instance, hn::BitCast(kF, hn::AndNot(last_bits, word)), lanes, out, slot);
  const VF rounded_length = hn::BitCast(kF, hn::ShiftLeft<23>(hn::And(word, last_bits)));
  const VF least = hn::Mul(rounded_length, set(instance.least_offset_m));
  store_lanes(hn::Max(rounding, least), lanes, out.offset.data() + slot);
  return hn::And(g_behind, lanes);
}

// The normal of an analytic shape and of voxels is the one that the hit brings, curved or flat:
// outward, in object space.
HWY_INLINE void store_shape(const InstanceRecord& instance, const RayHit& packet, const V3& viewer, MF lanes,
                            HitBatch& out, int slot) {
  V3 n = normal_to_world(instance, load3(packet.hit.Ng_x, packet.hit.Ng_y, packet.hit.Ng_z));
  const MF inside = hn::Lt(dot(n, viewer), hn::Zero(kF));
  n = select(inside, scale(n, set(-1.0f)), n);
  store_index_ratio(instance, inside, lanes, out, slot);
  store_lanes(n, lanes, out.normal, slot);
  store_lanes(n, lanes, out.geometric_normal, slot);
  store_curvature(instance, set(instance.kind == ShapeKind::sphere ? 1.0f : 0.0f), lanes, out, slot);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
