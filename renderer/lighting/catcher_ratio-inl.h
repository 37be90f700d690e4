// What is kept of the camera feed on a catcher, and what is added to it: irradiance with all that is virtual
// in place over that without it (differential rendering: Debevec 1998). Before: direct_light and what lights
// indirectly. After: resolve (first hits), second_rays (catchers in mirrors and glass).
#pragma once

#include <cmath>

#include "renderer/surfaces/surfaces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

constexpr float kSnapToOne = 0x1p-9f;  // below what 8 bits show: the feed must stay as it was, bit for bit
constexpr float kPi = 3.14159265f;

// E_with / E_without where there is light to compare, clamped and snapped.
HWY_INLINE VF catcher_ratio(VF with_objects, VF without, float smallest, float largest) {
  const VF one = set(1.0f);
  const VF ratio = hn::Min(hn::Div(with_objects, hn::Max(without, set(1e-30f))), set(largest));
  const MF keep =
      hn::Or(hn::Le(without, set(smallest)), hn::Lt(hn::Abs(hn::Sub(ratio, one)), set(kSnapToOne)));
  return hn::IfThenElse(keep, one, ratio);
}

// Irradiance that `ratio` does not carry: where it is clamped, or there is no light to compare with.
HWY_INLINE VF light_beyond(VF with_objects, VF without, VF ratio, float smallest, float largest) {
  const MF carried = hn::And(hn::Gt(without, set(smallest)), hn::Lt(ratio, set(largest)));
  return hn::IfThenZeroElse(carried, hn::Max(hn::NegMulAdd(ratio, without, with_objects), hn::Zero(kF)));
}

// Share of what virtual objects change about indirect light that is left at hits outside the grid of probes:
// look-ups there take the outermost probes, and what comes from within the grid falls with the square of the
// distance, R^2 / (R + d)^2 with R half its diagonal. 1 up to a cell beyond those probes.
HWY_INLINE VF share_outside(const ProbeView& view, const HitBatch& hits, int slot) {
  const V3 p = sub(load3(hits.position, slot), set3(view.lower));
  VF outside2 = hn::Zero(kF);
  float diagonal2 = 0;
  const auto axis = [&](VF at, std::size_t a) HWY_ATTR {
    const float spacing = 1 / view.inverse_spacing[a], extent = spacing * static_cast<float>(view.counts[a]);
    const VF beyond = hn::Max(hn::Sub(at, set(extent)), hn::Sub(set(-spacing), at));
    const VF off = hn::Max(beyond, hn::Zero(kF));
    outside2 = hn::MulAdd(off, off, outside2);
    diagonal2 += extent * extent;
  };
  axis(p.x, 0);
  axis(p.y, 1);
  axis(p.z, 2);
  const VF radius = set(0.5f * std::sqrt(diagonal2));
  const VF share = hn::Div(radius, hn::Add(radius, hn::Sqrt(outside2)));
  return hn::Mul(share, share);
}

struct CatcherLight {
  V3 added, ratio;
  MF beyond;  // where the ratio does not carry all virtual light
};

// What the feed keeps on catchers, and what is added to it: what they mirror, and of virtual light what the
// ratio cannot carry, as the difference of two renderings (Debevec 1998) of a surface that scatters its
// colour. Of hits [slot, slot + kLanes) that are lit as catchers; short rays and what they mirror count where
// they were traced.
HWY_INLINE CatcherLight catcher_light(const ShadingInputs& shading, const HitBatch& hits, int slot,
                                      bool occlusion, bool mirrors) {
  const VF zero = hn::Zero(kF), one = set(1.0f);
  const bool probes = shading.catcher_probes != nullptr;
  const VF open = occlusion ? hn::Max(load(&hits.open[slot]), zero) : one;
  const VF open_without = occlusion ? hn::Max(load(&hits.open_without[slot]), zero) : one;
  const VF left = probes ? share_outside(*shading.probes, hits, slot) : one;
  const MF outside = hn::Lt(left, one);
  CatcherLight out;
  out.beyond = first_lanes(0);
  const auto channel = [&](Lane<float> Lane3::*at, std::size_t c, VF& light, VF& ratio) HWY_ATTR {
    const VF pi = set(kPi), ambient = set(kPi * shading.ambient[c]);
    const VF all_without = probes ? hn::Mul(pi, load(&(hits.indirect_without.*at)[slot])) : ambient;
    VF all = probes ? hn::Mul(pi, load(&(hits.indirect.*at)[slot])) : ambient;
    all = hn::IfThenElse(outside, hn::MulAdd(left, hn::Sub(all, all_without), all_without), all);
    const VF with_objects = hn::MulAdd(all, open, load(&(hits.direct.*at)[slot]));
    const VF without = hn::MulAdd(all_without, open_without, load(&(hits.direct_without.*at)[slot]));
    const float smallest = shading.smallest_irradiance[c], largest = shading.largest_ratio;
    ratio = catcher_ratio(with_objects, without, smallest, largest);
    light = mirrors ? load(&(hits.mirrored.*at)[slot]) : zero;
    if (!shading.plan->virtual_lights) return;
    const VF rest = light_beyond(with_objects, without, ratio, smallest, largest);
    out.beyond = hn::Or(out.beyond, hn::Gt(rest, zero));
    const VF metal = hn::Max(hn::Sub(load(&(hits.f0.*at)[slot]), set(kUsualF0)), zero);
    light = hn::MulAdd(hn::Mul(rest, set(1 / kPi)), hn::Add(load(&(hits.diffuse.*at)[slot]), metal), light);
  };
  channel(&Lane3::x, 0, out.added.x, out.ratio.x);
  channel(&Lane3::y, 1, out.added.y, out.ratio.y);
  channel(&Lane3::z, 2, out.added.z, out.ratio.z);
  return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
