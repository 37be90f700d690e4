// The environment picture as a lobe of some alpha shows it. Before: filtered_environment made the levels.
// After: reflectance/sky_in_lobe-inl.h.
#pragma once

#include <hwy/contrib/math/math-inl.h>

#include "renderer/environment/environment-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

constexpr float kSharpestAlpha = 1e-3f;  // of roughness 0: the picture itself

// How much of what a lobe shows comes by levels and sources: all from the first level's alpha on, less of
// narrower ones, by their tails.
HWY_INLINE VF filtered_share(const FilteredRecord& from, VF alpha2) {
  const float first = from.first_alpha * from.first_alpha, sharpest = kSharpestAlpha * kSharpestAlpha;
  const float per_range = 1.0f / (first - sharpest);
  const VF tails = hn::Mul(hn::Sub(alpha2, set(sharpest)), set(per_range));
  return hn::Min(hn::Max(tails, hn::Zero(kF)), set(1.0f));
}

// Radiance without the bright sources' part. Between levels, where alpha lies in octaves between theirs.
// `direction`: unit, `alpha`: above 0, both in every lane; `turn`: EnvironmentRecord::turn.
HWY_INLINE V3 filtered_light(const FilteredRecord& from, float turn, const V3& direction, VF alpha) {
  const PicturePlace place = picture_place(turn, direction);
  const VF wider = hn::Mul(alpha, set(1.0f / from.first_alpha));
  const VF octaves = hn::Mul(hn::Log(kF, hn::Max(wider, set(1.0f))), set(1.44269504f));
  const VF level =
      hn::Min(hn::Mul(octaves, set(from.levels_per_octave)), set(static_cast<float>(from.levels - 1)));
  const VF whole = hn::Min(hn::Floor(level), set(static_cast<float>(from.levels - 2)));
  const VF between = hn::Sub(level, whole);
  const VI lower = hn::ConvertTo(kI, whole), upper = hn::Add(lower, hn::Set(kI, 1));
  const auto look = [&](VI at) HWY_ATTR {
    return picture_texel(from.texels, hn::GatherIndex(kI, from.first_texel, at),
                         hn::GatherIndex(kI, from.width, at), hn::GatherIndex(kI, from.height, at), place);
  };
  const V3 low = look(lower), high = look(upper);
  return mul_add(between, sub(high, low), low);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
