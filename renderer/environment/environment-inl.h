// Radiance that comes from outside the scene: one colour, or an equirectangular picture
// with bilinear filtering.
#pragma once

#include "renderer/simd/vector_angles-inl.h"
#include "renderer/tiles/tile_job.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// A place in an equirectangular picture: u to the right from the azimuth -180 degrees of an unturned one, v
// downwards from the zenith; [0, 1] each.
struct PicturePlace {
  VF u, v;
};

// A picture that was turned counter-clockwise shows in a direction what lies farther clockwise in it.
HWY_INLINE PicturePlace picture_place(float turn, const V3& direction) {
  constexpr float kTurnsPerRadian = 0.159154943f;
  const VF turns = hn::Mul(atan2(direction.x, hn::Neg(direction.z)), set(kTurnsPerRadian));
  VF u = hn::Add(turns, set(0.5f + turn));
  u = hn::Sub(u, hn::Floor(u));
  const VF across = hn::Sqrt(hn::MulAdd(direction.x, direction.x, hn::Mul(direction.z, direction.z)));
  return {u, hn::Mul(atan2(across, direction.y), set(2.0f * kTurnsPerRadian))};
}

// Bilinear, from `width` x `height` texels of each lane, the first of which is `first`.
HWY_INLINE V3 picture_texel(const float* texels, VI first, VI width, VI height, const PicturePlace& place) {
  const VF zero = hn::Zero(kF), one = set(1.0f), half = set(0.5f);
  const VF columns = hn::ConvertTo(kF, width), rows = hn::ConvertTo(kF, height);
  const VF x = hn::MulSub(place.u, columns, half), y = hn::MulSub(place.v, rows, half);
  const VF left = hn::Floor(x), upper = hn::Min(hn::Max(hn::Floor(y), zero), hn::Sub(rows, one));
  const VF tx = hn::Sub(x, left), ty = hn::Min(hn::Max(hn::Sub(y, upper), zero), one);
  // Columns wrap around; rows end at the poles.
  const VI step = hn::Set(kI, 1);
  const VI last_column = hn::Sub(width, step), last_row = hn::Sub(height, step);
  const VI c = hn::ConvertTo(kI, left), none = hn::Zero(kI);
  const VI c0 = hn::IfThenElse(hn::Lt(c, none), last_column, hn::Min(c, last_column));
  const VI c1 = hn::IfThenElse(hn::Eq(c0, last_column), none, hn::Add(c0, step));
  const VI r0 = hn::Min(hn::Max(hn::ConvertTo(kI, upper), none), last_row),
           r1 = hn::Min(hn::Add(r0, step), last_row);
  const auto fetch = [&](VI row, VI column) HWY_ATTR -> V3 {
    const VI at = hn::ShiftLeft<2>(hn::Add(first, hn::Add(hn::Mul(row, width), column)));
    return {hn::GatherIndex(kF, texels, at), hn::GatherIndex(kF, texels + 1, at),
            hn::GatherIndex(kF, texels + 2, at)};
  };
  const auto mix = [](const V3& a, const V3& b, VF t) HWY_ATTR { return mul_add(t, sub(b, a), a); };
  return mix(mix(fetch(r0, c0), fetch(r0, c1), tx), mix(fetch(r1, c0), fetch(r1, c1), tx), ty);
}

HWY_INLINE V3 environment_texel(const EnvironmentRecord& map, const V3& direction) {
  return picture_texel(map.texels, hn::Zero(kI), hn::Set(kI, map.width), hn::Set(kI, map.height),
                       picture_place(map.turn, direction));
}

// `direction`: unit, in every lane.
HWY_INLINE V3 environment_radiance(const ShadingInputs& shading, const V3& direction) {
  if (!shading.environment_map.texels) return set3(shading.environment);
  return environment_texel(shading.environment_map, direction);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
