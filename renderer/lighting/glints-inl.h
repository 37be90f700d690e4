// Whether lights can glint on clear glass, by a bound on its highlight: elsewhere glass that second rays pass
// needs no shadow ray. Before: surfaces. After: onward_rays.
#pragma once

#include <algorithm>
#include <cmath>

#include "renderer/direct_light/light_samples-inl.h"
#include "renderer/reflectance/interfaces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// A glint of less than this, in what is seen, is none: of the radiance of a white surface that faces the
// lights from the far end of the scene, which other surfaces outshine. Where that is a fortieth of the
// picture's white, as in a room lit from its middle, this is less than a quarter of an 8-bit step.
constexpr float kLeastGlint = 1.0f / 64.0f;

// Hits at which some light, unshadowed, may send a glint of `weight` into the ray that is seen. The half
// vector turns by half of what the light's places turn about its centre: GGX is taken that much nearer to its
// peak. Its joint visibility times n.l is 1 / (4 n.v) at most, but for its roughness.
HWY_INLINE MF may_glint(const ShadingInputs& shading, const HitBatch& hits, int slot, VF weight) {
  const VF zero = hn::Zero(kF), one = set(1.0f);
  const V3 n = load3(hits.normal, slot), v = load3(hits.viewer, slot), p = load3(hits.position, slot);
  const VF brightest = largest(load3(hits.f0, slot)), alpha2 = load(&hits.alpha2[slot]);
  const VF n_v = hn::Max(dot(n, v), set(0.02f));
  VF most = zero;
  float far_white = 0;
  for (const LightRecord& light : shading.lights) {
    const bool sun = light.kind == LightKind::sun;
    const V3 to_light = sun ? scale(set3(light.direction), set(-1.0f)) : sub(set3(light.centre), p);
    const VF distance2 = hn::Max(dot(to_light, to_light), set(1e-36f));
    const VF per_distance = hn::Div(one, hn::Sqrt(distance2));
    const V3 direction = scale(to_light, per_distance);
    const V3 h = normalise(add(direction, v));
    const float radius = 0.5f * std::sqrt(light.size[0] * light.size[0] + light.size[1] * light.size[1] +
                                          light.size[2] * light.size[2]);
    const VF turn = sun ? zero : hn::Mul(per_distance, set(0.5f * radius));
    const V3 off = cross(n, h);
    const VF away = hn::Max(hn::Sub(hn::Sqrt(dot(off, off)), hn::Add(turn, turn)), zero);
    const VF sample = hn::Mul(per_distance, set(meets_directions(light) ? 0.0f : light.half_turn_m));
    const VF l_h = hn::Max(dot(direction, h), zero);
    const VF wide2 = widened(hits, slot, alpha2, l_h, hn::Mul(sample, sample));
    const VF spread = hn::Max(hn::MulAdd(away, away, wide2), set(1e-12f));
    const VF lobe = hn::Div(hn::Mul(wide2, set(kInvPi)), hn::Mul(spread, spread));
    const VF reflects = hn::MulAdd(schlick_weight(hn::Sub(l_h, turn)), hn::Sub(one, brightest), brightest);
    // Within a light its falloff is what it is at its floor.
    const float intensity = std::max({light.intensity[0], light.intensity[1], light.intensity[2]});
    const float across = 0.5f * light.reach;  // the scene
    far_white += kInvPi * (sun ? intensity : intensity / across / across);
    const VF bright =
        hn::Mul(set(intensity),
                sun ? one : hn::Div(one, hn::Max(hn::Mul(distance2, set(0.25f)), set(light.min_distance2))));
    most = hn::MulAdd(hn::Mul(bright, lobe), hn::Div(reflects, n_v), most);
  }
  return hn::Gt(hn::Mul(weight, hn::Mul(set(0.25f), most)), set(kLeastGlint * far_white));
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
