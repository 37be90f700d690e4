// Bilinear fetch from an 8-bit RGBA texture, decoded to linear light before filtering.
// The sRGB curve is a cubic that stays within 0.0022 of IEC 61966-2-1 (tests/renderer measures it); 0 and 1
// are exact.
#if defined(HERR_TEXTURE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HERR_TEXTURE_INL
#undef HERR_TEXTURE_INL
#else
#define HERR_TEXTURE_INL
#endif

#include "renderer/simd_types-inl.h"
#include "scenes/scene.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

HWY_INLINE VF srgb_to_linear(VF c) {
  constexpr float kCubic = 0.305306011f, kSquare = 0.682171111f, kLinear = 1.0f - kCubic - kSquare;
  return hn::Mul(c, hn::MulAdd(c, hn::MulAdd(c, set(kCubic), set(kSquare)), set(kLinear)));
}

// Texture coordinate in texels, wrapped so that the bilinear pair (i0, i1) lies inside; `t` is the weight of
// i1.
HWY_INLINE void wrap_coordinate(VF coordinate, int size, std::uint8_t wrap, VI& i0, VI& i1, VF& t) {
  const VF extent = set(static_cast<float>(size));
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
  const VI zero = hn::Zero(kI), last = hn::Set(kI, size - 1);
  if (wrap == static_cast<std::uint8_t>(TextureWrap::repeat)) {
    i0 = hn::IfThenElse(hn::Lt(lower, zero), last, hn::Min(lower, last));
    i1 = hn::IfThenElse(hn::Gt(upper, last), zero, upper);
  } else {
    i0 = hn::Min(hn::Max(lower, zero), last);
    i1 = hn::Min(hn::Max(upper, zero), last);
  }
}

struct Rgb {
  VF r, g, b;
};

HWY_INLINE Rgb unpack(VU texel, bool srgb) {
  const VU byte = hn::Set(kU, 0xffu);
  const auto channel = [&](VU bits) HWY_ATTR {
    const VF c = hn::Mul(hn::ConvertTo(kF, hn::BitCast(kI, hn::And(bits, byte))), set(1.0f / 255.0f));
    return srgb ? srgb_to_linear(c) : c;
  };
  return {channel(texel), channel(hn::ShiftRight<8>(texel)), channel(hn::ShiftRight<16>(texel))};
}

HWY_INLINE Rgb lerp(const Rgb& a, const Rgb& b, VF t) {
  return {hn::MulAdd(t, hn::Sub(b.r, a.r), a.r), hn::MulAdd(t, hn::Sub(b.g, a.g), a.g),
          hn::MulAdd(t, hn::Sub(b.b, a.b), a.b)};
}

// (u, v) finite in every lane.
HWY_INLINE Rgb fetch_bilinear(const TextureRecord& texture, VF u, VF v) {
  VI x0, x1, y0, y1;
  VF tx, ty;
  wrap_coordinate(u, texture.width, texture.wrap_u, x0, x1, tx);
  wrap_coordinate(v, texture.height, texture.wrap_v, y0, y1, ty);
  const VI width = hn::Set(kI, texture.width);
  const VI row0 = hn::Mul(y0, width), row1 = hn::Mul(y1, width);
  const auto texel = [&](VI row, VI column) HWY_ATTR {
    return unpack(hn::GatherIndex(kU, texture.rgba8, hn::Add(row, column)), texture.srgb);
  };
  return lerp(lerp(texel(row0, x0), texel(row0, x1), tx), lerp(texel(row1, x0), texel(row1, x1), tx), ty);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();

#endif
