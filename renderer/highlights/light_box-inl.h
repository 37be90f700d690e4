// A lamp as directions meet it: the chord that a direction cuts through its box, and the falloff along it.
// A lamp shines uniformly from its box, I / V from each part of its volume V: along a direction its radiance
// is I / V times the integral of t^2 / max(t^2, r^2) over the chord. Of a plate, edges a and b, that is I /
// (a b cos) in the limit. Before: light records. After: lighting.
#pragma once

#include <algorithm>

#include "renderer/geometry/shading_scene.h"
#include "renderer/simd/simd_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Irradiance per unit of intensity and cosine: 1 / max(d^2, r^2), times a spot's cone and the end of its
// range (KHR_lights_punctual). `direction` is towards the light, unit. A sun is equally bright everywhere.
HWY_INLINE VF falloff(const LightRecord& light, VF distance2, const V3& direction) {
  const VF zero = hn::Zero(kF), one = set(1.0f);
  if (light.kind == LightKind::sun) return one;
  VF value = hn::Div(one, hn::Max(distance2, set(light.min_distance2)));
  if (light.kind == LightKind::spot) {
    const VF cosine = hn::Neg(dot(set3(light.direction), direction));
    const VF cone =
        hn::Min(hn::Max(hn::MulAdd(cosine, set(light.cone_scale), set(light.cone_offset)), zero), one);
    value = hn::Mul(value, hn::Mul(cone, cone));
  }
  if (light.inverse_range2 > 0) {
    const VF share = hn::Mul(distance2, set(light.inverse_range2));
    value = hn::Mul(value, hn::Max(hn::NegMulAdd(share, share, one), zero));
  }
  return value;
}

// Whether directions can meet the light: rods and points have no extent to meet. One sample is the highlight
// of the middle, as wide as the light.
constexpr float kThinnestRod = 0.01f;
HWY_INLINE bool meets_directions(const LightRecord& light) {
  const float x = light.size[0], y = light.size[1], z = light.size[2];
  const float longest = std::max({x, y, z});
  const float middle = std::max(std::min(x, y), std::min(std::max(x, y), z));
  return light.samples > 1 && middle > kThinnestRod * longest;
}

// The light's box. Plates are a thousandth of their longest edge thick.
struct LightBox {
  float centre[3], half[3];
  float volume;
};
HWY_INLINE LightBox box_of(const LightRecord& light) {
  constexpr float kPlate = 1e-3f;
  const float longest = std::max({light.size[0], light.size[1], light.size[2]});
  LightBox box;
  box.volume = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const float size = std::max(light.size[axis], kPlate * longest);
    box.centre[axis] = light.centre[axis];
    box.half[axis] = 0.5f * size;
    box.volume *= size;
  }
  return box;
}

// What a ray from `p` along `direction` (unit) has of the box; no length, or less, where it misses.
struct Chord {
  VF begin, length;
};
HWY_INLINE Chord chord_through(const LightBox& box, const V3& p, const V3& direction) {
  VF middle[3], half[3];
  const VF from[3] = {p.x, p.y, p.z}, along[3] = {direction.x, direction.y, direction.z};
  for (int axis = 0; axis < 3; ++axis) {
    const VF per_length =
        hn::Div(set(1.0f), hn::CopySign(hn::Max(hn::Abs(along[axis]), set(1e-9f)), along[axis]));
    middle[axis] = hn::Mul(hn::Sub(set(box.centre[axis]), from[axis]), per_length);
    half[axis] = hn::Mul(set(box.half[axis]), hn::Abs(per_length));
  }
  const auto least = [](VF a, VF b, VF c) HWY_ATTR { return hn::Min(a, hn::Min(b, c)); };
  const VF zero = hn::Zero(kF);
  const VF begin = hn::Neg(least(zero, hn::Sub(half[0], middle[0]),
                                 hn::Min(hn::Sub(half[1], middle[1]), hn::Sub(half[2], middle[2]))));
  const VF end = least(hn::Add(half[0], middle[0]), hn::Add(half[1], middle[1]), hn::Add(half[2], middle[2]));
  // The length by each two faces, not as a difference of distances: a plate's is not lost in rounding.
  const auto between = [&](int a, int b) HWY_ATTR {
    return hn::Sub(hn::Add(half[a], half[b]), hn::Abs(hn::Sub(middle[a], middle[b])));
  };
  const VF through = least(hn::Add(half[0], half[0]), hn::Add(half[1], half[1]), hn::Add(half[2], half[2]));
  const VF across = least(between(0, 1), between(0, 2), between(1, 2));
  return {begin, least(through, across, end)};
}

// `t` moved to where the light itself lies along the way: what a plate was thickened by may lie within the
// surface that the plate hangs on.
HWY_INLINE VF within_light(const LightRecord& light, const LightBox& box, const Chord& chord, const V3& p,
                           const V3& direction, VF t) {
  const VF from[3] = {p.x, p.y, p.z}, along[3] = {direction.x, direction.y, direction.z};
  for (int axis = 0; axis < 3; ++axis) {
    const float half = 0.5f * light.size[axis];
    if (half >= box.half[axis]) continue;
    const VF per_length = hn::Div(set(1.0f), along[axis]);
    const VF middle = hn::Mul(hn::Sub(set(box.centre[axis]), from[axis]), per_length);
    const VF reach = hn::Mul(set(half), hn::Abs(per_length));
    const VF inside = hn::Min(hn::Max(t, hn::Sub(middle, reach)), hn::Add(middle, reach));
    t = hn::Min(hn::Max(inside, chord.begin), hn::Add(chord.begin, chord.length));
  }
  return t;
}

// How densely a light's samples lie along a direction, per steradian: N / V times the integral of t^2.
HWY_INLINE VF density_of_strata(const LightRecord& light, const LightBox& box, const Chord& chord) {
  const VF length = hn::Max(chord.length, hn::Zero(kF));
  const VF square = hn::MulAdd(chord.begin, hn::Add(chord.begin, length),
                               hn::Mul(set(1.0f / 3.0f), hn::Mul(length, length)));
  return hn::Mul(hn::Mul(set(static_cast<float>(light.samples) / box.volume), length), square);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
