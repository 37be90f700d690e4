// Vertex colours, further textures and coordinates, strength of highlights, unlit surfaces: what few
// materials have. Compiled into the kernels of scenes that need it only.
#pragma once

#include "renderer/surfaces/material_at-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// White where the slot has no texture.
HWY_INLINE Rgba fetch_use(const TextureUse& use, VI record, const Barycentric& at, VF object_width2,
                          MF lanes) {
  if (use.texture == nullptr) return {set(1.0f), set(1.0f), set(1.0f), set(1.0f)};
  const TexturePlace place =
      texture_place(use.coordinates, use.uv_lower, use.uv_scale, record, at, object_width2);
  return fetch_texture(*use.texture, place.u, place.v, place.width2, lanes);
}

HWY_INLINE Rgba vertex_colour(const ColourRecord* colours, VI record, const Barycentric& at) {
  const auto* words = reinterpret_cast<const std::uint32_t*>(colours);
  const auto channel = [&](int word, bool high) HWY_ATTR {
    const auto corner = [&](int i) HWY_ATTR {
      return unorm_lane(hn::GatherIndex(kU, words + 2 * i + word, record), high);
    };
    const VF sum = hn::MulAdd(at.w, corner(0), hn::MulAdd(at.u, corner(1), hn::Mul(at.v, corner(2))));
    return hn::Mul(sum, set(1.0f / 65535.0f));
  };
  return {channel(0, false), channel(0, true), channel(1, false), channel(1, true)};
}

// KHR_materials_specular: F0 = min(F0 colour, 1) strength, F90 = strength.
HWY_INLINE void weigh_highlights(const DetailRecord& detail, VI record, const Barycentric& at,
                                 VF object_width2, MF lanes, MaterialAt& m) {
  const VF one = set(1.0f);
  VF strength = set(detail.specular);
  if (detail.specular_use.texture != nullptr) {
    strength = hn::Mul(strength, fetch_use(detail.specular_use, record, at, object_width2, lanes).a);
  }
  const Rgba tint = fetch_use(detail.specular_colour, record, at, object_width2, lanes);
  const auto weigh = [&](VF f0, float factor, VF texel) HWY_ATTR {
    return hn::Mul(hn::Min(hn::Mul(f0, hn::Mul(set(factor), texel)), one), strength);
  };
  m.f0 = {weigh(m.f0.x, detail.specular_rgb[0], tint.r), weigh(m.f0.y, detail.specular_rgb[1], tint.g),
          weigh(m.f0.z, detail.specular_rgb[2], tint.b)};
  m.f90 = strength;
}

HWY_INLINE void apply_details(const DetailRecord& detail, VI record, const Barycentric& at, VF object_width2,
                              MF lanes, MaterialAt& m) {
  if (detail.colours != nullptr) multiply_base(m, vertex_colour(detail.colours, record, at));
  if (detail.base_colour.texture != nullptr) {
    multiply_base(m, fetch_use(detail.base_colour, record, at, object_width2, lanes));
  }
  m.base.a = hn::Min(hn::Max(hn::Mul(m.base.a, set(detail.alpha)), hn::Zero(kF)), set(1.0f));
  if (detail.metallic_roughness.texture != nullptr) {
    multiply_rough(m, fetch_use(detail.metallic_roughness, record, at, object_width2, lanes));
  }
  if (detail.emission.texture != nullptr) {
    const Rgba texel = fetch_use(detail.emission, record, at, object_width2, lanes);
    m.emission = {hn::Mul(m.emission.x, texel.r), hn::Mul(m.emission.y, texel.g),
                  hn::Mul(m.emission.z, texel.b)};
  }
  if (detail.transmission.texture != nullptr) {
    const Rgba texel = fetch_use(detail.transmission, record, at, object_width2, lanes);
    m.transmission = hn::Mul(m.transmission, texel.r);
  }
  if (detail.occlusion.texture != nullptr) {
    const VF texel = fetch_use(detail.occlusion, record, at, object_width2, lanes).r;
    m.occlusion = hn::MulAdd(set(detail.occlusion_strength), hn::Sub(texel, set(1.0f)), set(1.0f));
  }
  weigh_highlights(detail, record, at, object_width2, lanes, m);
  if (!detail.unlit) return;
  // What it shows is its colour, whatever the light: that is emission.
  const VF zero = hn::Zero(kF);
  m.emission = {m.base.r, m.base.g, m.base.b};
  m.base.r = m.base.g = m.base.b = zero;
  m.f0 = {zero, zero, zero};
  m.metallic = m.f90 = zero;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
