// The environment picture as a lobe of some alpha shows it. Before: filtered_environment made the levels.
// After: lighting/gloss-inl.h.
#pragma once

#include <hwy/contrib/math/math-inl.h>

#include "renderer/environment/environment-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

struct FilteredLight {
  V3 radiance;
  VF sources;  // share of the bright sources that is not in it
};

constexpr float kSharpestAlpha = 1e-3f;  // of roughness 0: the picture itself

// Between levels, where alpha lies in octaves between theirs. `direction`: unit, `alpha`: above 0, both in
// every lane.
HWY_INLINE FilteredLight filtered_light(const FilteredRecord& from, const EnvironmentRecord& sharp,
                                        const V3& direction, VF alpha) {
  const VF zero = hn::Zero(kF), one = set(1.0f);
  const PicturePlace place = picture_place(sharp.turn, direction);
  const VF wider = hn::Mul(alpha, set(1.0f / from.first_alpha));
  const VF octaves = hn::Mul(hn::Log(kF, hn::Max(wider, one)), set(1.44269504f));
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
  FilteredLight out{mul_add(between, sub(high, low), low), zero};
  const VF apart = hn::Sub(level, set(static_cast<float>(from.first_without_sources - 1)));
  out.sources = hn::Min(hn::Max(apart, zero), one);
  const MF narrow = hn::Lt(wider, one);
  if (hn::AllFalse(kF, narrow)) return out;
  const V3 seen =
      picture_texel(sharp.texels, hn::Zero(kI), hn::Set(kI, sharp.width), hn::Set(kI, sharp.height), place);
  const float sharpest = kSharpestAlpha / from.first_alpha, per_range = 1.0f / (1.0f - sharpest * sharpest);
  const VF tails =
      hn::Max(hn::MulAdd(hn::Mul(wider, wider), set(per_range), set(-sharpest * sharpest * per_range)), zero);
  const V3 blurred = mul_add(tails, sub(out.radiance, seen), seen);
  out.radiance = select(narrow, blurred, out.radiance);
  return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
