// Stage: Embree hits -> position, normals and material of each ray of a batch.
// Rays of a packet mostly hit one instance, so the packet is taken instance by instance: matrices, material
// and textures are then broadcast, and only the triangle's record is gathered.
#pragma once

#include "renderer/surfaces/further_lobes-inl.h"
#include "renderer/tiles/generate_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Secondary rays start off the surface by 256 units in the last place of the largest coordinate or distance
// that went into the hit point, along the geometric normal (after Waechter & Binder, "A Fast and Robust
// Method for Avoiding Self-Intersection", 2019; they take each coordinate's own, which is too little for p =
// o + t d near a plane of 0), and at least by what rounds where the triangle or shape was met in its own
// space.
constexpr float kOffsetScale = 0x1p-16f;

// What surfaces are looked up for. colours: all that they send back. matte: as probes take them, what they
// scatter is in `diffuse`.
enum class SurfaceUse : std::uint8_t { colours, matte };

// A dielectric's F0 up to which its highlights are left out of what it scatters, and from which on they count
// in full.
constexpr float kUsualF0 = 0.04f, kStrongF0 = 0.08f;

// What a surface scatters evenly: `diffuse`, a metal its colour, and a dielectric whose highlights are strong
// theirs, of which its diffuse layer misses what is `held_back`.
HWY_INLINE V3 matte_albedo(const MaterialAt& m, const V3& base, const V3& diffuse, VF held_back) {
  const VF f0 = hn::Max(m.f0.x, hn::Max(m.f0.y, m.f0.z));
  const VF strong =
      hn::Min(hn::Max(hn::Mul(hn::Sub(f0, set(kUsualF0)), set(1.0f / (kStrongF0 - kUsualF0))), hn::Zero(kF)),
              set(1.0f));
  const VF dielectric = hn::Mul(strong, hn::Sub(set(1.0f), m.metallic));
  const auto channel = [&](VF metal, VF layer, VF highlight) HWY_ATTR {
    const VF under = hn::NegMulAdd(hn::Mul(strong, held_back), layer, layer);
    return hn::Min(hn::MulAdd(m.metallic, metal, hn::MulAdd(dielectric, highlight, under)), set(1.0f));
  };
  return {channel(base.x, diffuse.x, m.f0.x), channel(base.y, diffuse.y, m.f0.y),
          channel(base.z, diffuse.z, m.f0.z)};
}

// Share of the mirror ray that a surface shows by its roughness. One ray stands for lobes up to kSharpMirror,
// for none from kRoughestMirror on, and for a share of what lies between; what glass mirrors fades from 0 on.
constexpr float kSharpMirror = 0.2f;
HWY_INLINE VF mirror_by_roughness(const InstanceRecord& instance, const MaterialAt& m) {
  const VF zero = hn::Zero(kF), one = set(1.0f);
  const float fades = instance.transmission > 0 ? kRoughestMirror : kRoughestMirror - kSharpMirror;
  const VF share =
      hn::Min(hn::Max(hn::Mul(hn::Sub(set(kRoughestMirror), m.roughness), set(1.0f / fades)), zero), one);
  if (!(instance.transmission > 0)) return share;
  const VF clear = hn::Mul(hn::Sub(one, m.metallic), m.transmission);
  return hn::Mul(share, hn::Min(hn::Max(m.metallic, clear), one));
}

// Material of one instance at `lanes`: factors times textures, split into diffuse and specular reflectance,
// and what passes where the frame follows light through transparent surfaces.
template <SurfaceDetail kDetail>
HWY_INLINE void store_material(const InstanceRecord& instance, VI record, const Barycentric& at,
                               VF object_width2, const ShadingInputs& shading, SurfaceUse use, MF lanes,
                               HitBatch& out, int slot) {
  MaterialAt m = material_factors(instance);
  if constexpr (kDetail != SurfaceDetail::plain) {
    apply_base_textures(instance, record, at, object_width2, lanes, m);
    if (instance.kind == ShapeKind::voxels) multiply_voxel_colour(at.u, m);
  }
  const auto put = [&](VF value, Lane<float>& lane)
                       HWY_ATTR { store_lanes(value, lanes, lane.data() + slot); };
  if constexpr (kDetail == SurfaceDetail::all) {
    put(set(1.0f), out.coverage);
    if (instance.detail) {
      apply_details(*instance.detail, record, at, object_width2, lanes, m);
      if (instance.detail->alpha_mode == AlphaMode::blend) put(m.base.a, out.coverage);
    }
    put(hn::MulAdd(m.metallic, hn::Sub(set(1.0f), m.f90), m.f90), out.f90);
    put(m.occlusion, out.occlusion);
  }
  const V3 base{m.base.r, m.base.g, m.base.b};
  VF dielectric = hn::Sub(set(1.0f), m.metallic);
  VF held_back = hn::Max(m.f0.x, hn::Max(m.f0.y, m.f0.z));
  if (instance.dielectric_f0 >= 1.0f) {
    // Index 0: light that is not reflected goes on, as KHR_materials_ior and _specular mix it.
    dielectric = hn::Mul(dielectric, hn::Sub(set(1.0f), held_back));
    held_back = hn::Zero(kF);
  }
  if (shading.plan->refraction) {
    // What passes the surface is not scattered by it, but to probes, whose rays end at it.
    const VF transmission = hn::Mul(dielectric, m.transmission);
    if (use == SurfaceUse::colours) dielectric = hn::Sub(dielectric, transmission);
    put(transmission, out.transmission);
    put(set(instance.dielectric_f0), out.dielectric_f0);
    store_lanes(base, lanes, out.tint, slot);
    store_lanes(set3(instance.absorption), lanes, out.absorption, slot);
  }
  const V3 diffuse = scale(base, dielectric);
  store_lanes(use == SurfaceUse::matte ? matte_albedo(m, base, diffuse, held_back) : diffuse, lanes,
              out.diffuse, slot);
  if (shading.probes != nullptr || shading.plan->gloss) put(held_back, out.held_back);
  store_lanes(mul_add(m.metallic, sub(base, m.f0), m.f0), lanes, out.f0, slot);
  const VF alpha = hn::Max(hn::Mul(m.roughness, m.roughness), set(kSmallestAlpha));
  put(hn::Mul(alpha, alpha), out.alpha2);
  store_lanes(m.emission, lanes, out.emission, slot);
  const bool by_roughness = instance.mirror < 0;
  const bool own = by_roughness && !(instance.transmission > 0) && shading.plan->gloss;
  put(!by_roughness                      ? set(instance.mirror)
      : own || instance.transmission > 0 ? mirror_by_roughness(instance, m)
                                         : hn::Zero(kF),
      out.mirror);
  if (out.gloss) put(set(own ? 1.0f : 0.0f), out.gloss->own);
  put(set(instance.catcher ? 1.0f : 0.0f), out.is_catcher);
}

// One traced packet -> lanes [slot, slot + kLanes) of `out`. Lanes of `rays` that hit nothing become `miss`;
// a catcher counts as an object where `see_catchers` (a mirror shows the real room by its stated colour).
// HitBatch::cone_width and cone_spread are the rays' at the origin before, and the width is the hit's
// afterwards. Returns where the back of a surface is seen that shows eyes its front only.
template <SurfaceDetail kDetail>
HWY_NOINLINE MF surface_of_packet(const RayHit& packet, MF rays, const ShadingInputs& shading,
                                  bool see_catchers, HitBatch& out, int slot,
                                  SurfaceUse use = SurfaceUse::colours) {
  const VU geometry = hn::Load(kU, packet.hit.geomID);
  const VU instance_ids = hn::Load(kU, packet.hit.instID[0]);
  const MF hit = hn::And(rays, hn::RebindMask(kF, hn::Ne(geometry, hn::Set(kU, RTC_INVALID_GEOMETRY_ID))));
  VI kind = hn::IfThenElseZero(hn::RebindMask(kI, rays), hn::Set(kI, static_cast<int>(HitKind::miss)));
  const V3 direction = load3(packet.ray.dir_x, packet.ray.dir_y, packet.ray.dir_z);
  const V3 viewer = scale(direction, set(-1.0f));
  store3(viewer, out.viewer, slot);
  if (hn::AllFalse(kF, hit)) {
    hn::Store(kind, kI, out.kind.data() + slot);
    return hit;
  }
  const V3 origin = load3(packet.ray.org_x, packet.ray.org_y, packet.ray.org_z);
  const VF t = hn::IfThenElseZero(hit, load(packet.ray.tfar));
  const V3 p = mul_add(t, direction, origin);
  store3(p, out.position, slot);
  const VF largest = hn::Max(hn::Max(hn::Abs(p.x), hn::Abs(p.y)), hn::Max(hn::Abs(p.z), t));
  const VF rounding = hn::Mul(largest, set(kOffsetScale));
  hn::Store(rounding, kF, out.offset.data() + slot);

  const VF u = load(packet.hit.u), v = load(packet.hit.v);
  const Barycentric at{hn::Sub(hn::Sub(set(1.0f), u), v), u, v};
  const VI records = hn::ShiftLeft<3>(hn::BitCast(kI, hn::Load(kU, packet.hit.primID)));
  const VF width = hn::MulAdd(load(&out.cone_spread[slot]), t, load(&out.cone_width[slot]));
  store_lanes(width, hit, &out.cone_width[slot]);
  const VF area = hn::Mul(width, width);  // of the ray's cross section on the surface, but for its slope
  MF left = hit, backs = first_lanes(0);
  while (!hn::AllFalse(kF, left)) {
    const auto first = static_cast<std::size_t>(hn::FindFirstTrue(kF, left));
    const std::uint32_t id = packet.hit.instID[0][first];
    const MF lanes = hn::And(left, hn::RebindMask(kF, hn::Eq(instance_ids, hn::Set(kU, id))));
    left = hn::AndNot(lanes, left);
    const InstanceRecord& instance = shading.instances[id];
    const VI record = hn::IfThenElseZero(hn::RebindMask(kI, lanes), records);
    if (instance.kind == ShapeKind::mesh) {
      const MF behind = store_normals(instance, record, at, packet, viewer, rounding, lanes, out, slot);
      if (instance.back_face_culling) backs = hn::Or(backs, behind);
    } else {
      store_lanes(hn::Max(rounding, set(instance.least_offset_m)), lanes, out.offset.data() + slot);
      store_shape(instance, packet, viewer, lanes, out, slot);
    }
    VF object_width2 = area;
    if constexpr (kDetail != SurfaceDetail::plain) {
      const VF slope = hn::Abs(dot(load3(out.geometric_normal, slot), viewer));
      object_width2 = hn::Div(hn::Mul(area, face_per_world2(instance, packet)), hn::Max(slope, set(1e-3f)));
    }
    if constexpr (kDetail == SurfaceDetail::all) {
      if (out.lobes) store_coat_normal(instance, record, at, object_width2, lanes, out, slot);
      if (const DetailRecord* detail = instance.detail; detail && detail->normal.texture != nullptr) {
        store_lanes(bent_normals(instance, detail->normal, detail->normal_scale, record, at, object_width2,
                                 lanes, out, slot),
                    lanes, out.normal, slot);
      }
      if (out.lobes) store_lobes(instance, record, at, object_width2, lanes, out, slot);
    }
    store_material<kDetail>(instance, record, at, object_width2, shading, use, lanes, out, slot);
    const HitKind of_instance = instance.catcher && !see_catchers ? HitKind::catcher : HitKind::object;
    kind = hn::IfThenElse(hn::RebindMask(kI, lanes), hn::Set(kI, static_cast<int>(of_instance)), kind);
  }
  hn::Store(kind, kI, out.kind.data() + slot);
  return backs;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
