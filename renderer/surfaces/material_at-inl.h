// A material where rays hit it: factors times the two textures that most materials have at most.
// Before: surfaces knows triangle and place. After: surface_details adds the rest;
// surfaces stores the outcome.
#pragma once

#include "renderer/surfaces/texture-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

struct Barycentric {
  VF w, u, v;
};

HWY_INLINE VF unorm_lane(VU packed, bool high) {
  const VU bits = high ? hn::ShiftRight<16>(packed) : hn::And(packed, hn::Set(kU, 0xffffu));
  return hn::ConvertTo(kF, hn::BitCast(kI, bits));
}

// Coordinates of a texture at `lanes`, and the squared width that a ray has in them.
struct TexturePlace {
  VF u, v, width2;
};

HWY_INLINE TexturePlace texture_place(const TriangleRecord* coordinates, const float uv_lower[2],
                                      const float uv_scale[2], VI record, const Barycentric& at,
                                      VF object_width2) {
  const auto* words = reinterpret_cast<const std::uint32_t*>(coordinates);
  const VU uv0 = hn::GatherIndex(kU, words + 3, record), uv1 = hn::GatherIndex(kU, words + 4, record),
           uv2 = hn::GatherIndex(kU, words + 5, record);
  const auto interpolate = [&](bool high, int axis) HWY_ATTR {
    const VF q = hn::MulAdd(at.w, unorm_lane(uv0, high),
                            hn::MulAdd(at.u, unorm_lane(uv1, high), hn::Mul(at.v, unorm_lane(uv2, high))));
    return hn::MulAdd(q, set(uv_scale[axis]), set(uv_lower[axis]));
  };
  const VF density = hn::GatherIndex(kF, reinterpret_cast<const float*>(coordinates) + 6, record);
  return {interpolate(false, 0), interpolate(true, 1), hn::Mul(object_width2, density)};
}

// What a material has at `lanes`, factors times textures.
struct MaterialAt {
  Rgba base;
  VF metallic, roughness, transmission;
  V3 emission, f0;  // f0: of a dielectric
  VF f90, occlusion;
};

HWY_INLINE MaterialAt material_factors(const InstanceRecord& instance) {
  const VF f0 = set(instance.dielectric_f0), one = set(1.0f);
  return {{set(instance.base_colour[0]), set(instance.base_colour[1]), set(instance.base_colour[2]), one},
          set(instance.metallic),
          set(instance.roughness),
          set(instance.transmission),
          set3(instance.emission),
          {f0, f0, f0},
          one,
          one};
}

HWY_INLINE void multiply_base(MaterialAt& m, const Rgba& texel) {
  m.base = {hn::Mul(m.base.r, texel.r), hn::Mul(m.base.g, texel.g), hn::Mul(m.base.b, texel.b),
            hn::Mul(m.base.a, texel.a)};
}
HWY_INLINE void multiply_rough(MaterialAt& m, const Rgba& texel) {
  m.roughness = hn::Mul(m.roughness, texel.g);
  m.metallic = hn::Mul(m.metallic, texel.b);
}

// The colour of voxels comes with the hit: see voxel_geometry.
HWY_INLINE void multiply_voxel_colour(VF hit_u, MaterialAt& m) {
  const VU bits = hn::BitCast(kU, hit_u);
  const auto channel = [](VU root) HWY_ATTR {
    const VF value =
        hn::Mul(hn::ConvertTo(kF, hn::BitCast(kI, hn::And(root, hn::Set(kU, 1023u)))), set(1.0f / 1023.0f));
    return hn::Mul(value, value);
  };
  multiply_base(
      m, {channel(bits), channel(hn::ShiftRight<10>(bits)), channel(hn::ShiftRight<20>(bits)), set(1.0f)});
}

HWY_INLINE void apply_base_textures(const InstanceRecord& instance, VI record, const Barycentric& at,
                                    VF object_width2, MF lanes, MaterialAt& m) {
  if (!instance.base_colour_texture && !instance.metallic_roughness_texture) return;
  const TexturePlace place =
      texture_place(instance.triangles, instance.uv_lower, instance.uv_scale, record, at, object_width2);
  if (instance.base_colour_texture) {
    multiply_base(m, fetch_texture(*instance.base_colour_texture, place.u, place.v, place.width2, lanes));
  }
  if (instance.metallic_roughness_texture) {
    multiply_rough(
        m, fetch_texture(*instance.metallic_roughness_texture, place.u, place.v, place.width2, lanes));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
