// Fetch from an 8-bit RGBA texture, decoded to linear light before filtering: bilinear where it is
// magnified, else trilinear between the two levels that the ray's width asks for (a level alone would show
// its border). The sRGB curve is a polynomial, of IEC 61966-2-1 within half a step of 8 bits
// at each of them (tests/renderer measures it); 0 and 1 are exact.
#pragma once

#include "renderer/geometry/shading_scene.h"
#include "renderer/simd/simd_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

HWY_INLINE VF srgb_to_linear(VF c) {
  // Multiples of 2^-16, so that their sums are exact, with a sum of 1.
  constexpr float k5 = 0x1p-16f * 43703, k4 = 0x1p-16f * -107344, k3 = 0x1p-16f * 111320,
                  k2 = 0x1p-16f * 13530, k1 = 0x1p-16f * 4327;
  static_assert(k5 + k4 + k3 + k2 + k1 == 1.0f);
  const VF high = hn::MulAdd(c, hn::MulAdd(c, set(k5), set(k4)), set(k3));
  return hn::Mul(c, hn::MulAdd(c, hn::MulAdd(c, high, set(k2)), set(k1)));
}

// Texture coordinate in texels, wrapped so that the bilinear pair (i0, i1) lies inside;
// `t` is the weight of i1.
HWY_INLINE void wrap_coordinate(VF coordinate, VI size, std::uint8_t wrap, VI& i0, VI& i1, VF& t) {
  const VF extent = hn::ConvertTo(kF, size);
  const VF one = set(1.0f);
  VF c = coordinate;
  if (wrap == static_cast<std::uint8_t>(TextureWrap::repeat)) {
    c = hn::Sub(c, hn::Floor(c));
  } else if (wrap == static_cast<std::uint8_t>(TextureWrap::mirror)) {
    const VF folded = hn::Sub(c, hn::Mul(set(2.0f), hn::Floor(hn::Mul(c, set(0.5f)))));  // [0, 2)
    c = hn::Min(folded, hn::Sub(set(2.0f), folded));
  } else {
    c = hn::Min(hn::Max(c, hn::Zero(kF)), one);
  }
  const VF x = hn::MulSub(c, extent, set(0.5f));
  const VF base = hn::Floor(x);
  t = hn::Sub(x, base);
  const VI lower = hn::ConvertTo(kI, base), upper = hn::Add(lower, hn::Set(kI, 1));
  const VI zero = hn::Zero(kI), last = hn::Sub(size, hn::Set(kI, 1));
  if (wrap == static_cast<std::uint8_t>(TextureWrap::repeat)) {
    i0 = hn::IfThenElse(hn::Lt(lower, zero), last, hn::Min(lower, last));
    i1 = hn::IfThenElse(hn::Gt(upper, last), zero, upper);
  } else {
    i0 = hn::Min(hn::Max(lower, zero), last);
    i1 = hn::Min(hn::Max(upper, zero), last);
  }
}

struct Rgba {
  VF r, g, b, a;
};

HWY_INLINE Rgba unpack(VU texel, bool srgb) {
  const VU byte = hn::Set(kU, 0xffu);
  const auto share = [&](VU bits) HWY_ATTR {
    return hn::Mul(hn::ConvertTo(kF, hn::BitCast(kI, hn::And(bits, byte))), set(1.0f / 255.0f));
  };
  const auto channel = [&](VU bits) HWY_ATTR { return srgb ? srgb_to_linear(share(bits)) : share(bits); };
  return {channel(texel), channel(hn::ShiftRight<8>(texel)), channel(hn::ShiftRight<16>(texel)),
          share(hn::ShiftRight<24>(texel))};
}

HWY_INLINE Rgba lerp(const Rgba& a, const Rgba& b, VF t) {
  return {hn::MulAdd(t, hn::Sub(b.r, a.r), a.r), hn::MulAdd(t, hn::Sub(b.g, a.g), a.g),
          hn::MulAdd(t, hn::Sub(b.b, a.b), a.b), hn::MulAdd(t, hn::Sub(b.a, a.a), a.a)};
}

// Bilinear from one level of `width` x `height` texels, the first of which is `first`.
HWY_INLINE Rgba fetch_level(const TextureRecord& texture, VI width, VI height, VI first, VF u, VF v) {
  VI x0, x1, y0, y1;
  VF tx, ty;
  wrap_coordinate(u, width, texture.wrap_u, x0, x1, tx);
  wrap_coordinate(v, height, texture.wrap_v, y0, y1, ty);
  const VI row0 = hn::Add(hn::Mul(y0, width), first), row1 = hn::Add(hn::Mul(y1, width), first);
  const auto texel = [&](VI row, VI column) HWY_ATTR {
    return unpack(hn::GatherIndex(kU, texture.rgba8, hn::Add(row, column)), texture.srgb);
  };
  return lerp(lerp(texel(row0, x0), texel(row0, x1), tx), lerp(texel(row1, x0), texel(row1, x1), tx), ty);
}

// A level of its own for each lane.
HWY_INLINE Rgba fetch_levels(const TextureRecord& texture, VI level, VF u, VF v) {
  const auto along = [&](int size) HWY_ATTR {
    const VI shrunk =
        hn::BitCast(kI, hn::Shr(hn::Set(kU, static_cast<std::uint32_t>(size)), hn::BitCast(kU, level)));
    return hn::Max(shrunk, hn::Set(kI, 1));
  };
  return fetch_level(texture, along(texture.width), along(texture.height),
                     hn::GatherIndex(kI, texture.first_texel.data(), level), u, v);
}

// log2 of a positive normal number: straight between powers of two, at most 0.09 too low.
HWY_INLINE VF rough_log2(VF x) {
  const VF bits = hn::ConvertTo(kF, hn::BitCast(kI, x));
  return hn::MulAdd(bits, set(0x1p-23f), set(-127.0f));
}

// (u, v) finite in every lane. `width2`: squared width of the ray in texture coordinates, of area 1. `lanes`:
// those that count.
HWY_NOINLINE inline Rgba fetch_texture(const TextureRecord& texture, VF u, VF v, VF width2, MF lanes) {
  const VF zero = hn::Zero(kF);
  const VF texels2 =
      hn::Mul(width2, set(static_cast<float>(texture.width) * static_cast<float>(texture.height)));
  // The width in texels is 2^level: a half, since the number is its square. NaN reads level 0.
  const VF positive = hn::IfThenElse(hn::Gt(texels2, set(1e-30f)), hn::Min(texels2, set(1e30f)), set(1e-30f));
  const VF level = hn::Min(hn::Max(hn::Mul(rough_log2(positive), set(0.5f)), zero),
                           set(static_cast<float>(texture.levels - 1)));
  const MF smaller = hn::And(lanes, hn::Gt(level, zero));
  if (hn::AllFalse(kF, smaller)) {
    const VI width = hn::Set(kI, texture.width), height = hn::Set(kI, texture.height);
    if (texture.nearest) {
      const auto centre = [](VF c, int size) HWY_ATTR {
        const VF n = set(static_cast<float>(size));
        return hn::Div(hn::Add(hn::Floor(hn::Mul(c, n)), set(0.5f)), n);
      };
      u = centre(u, texture.width);
      v = centre(v, texture.height);
    }
    return fetch_level(texture, width, height, hn::Zero(kI), u, v);
  }
  const VF whole = hn::Floor(level);
  const VI finer = hn::ConvertTo(kI, whole);
  const VI coarser = hn::Min(hn::Add(finer, hn::Set(kI, 1)), hn::Set(kI, texture.levels - 1));
  return lerp(fetch_levels(texture, finer, u, v), fetch_levels(texture, coarser, u, v),
              hn::Sub(level, whole));
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
