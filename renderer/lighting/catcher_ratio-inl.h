// What share of the camera feed is kept on a catcher: irradiance with the virtual objects in place over that
// without them (differential rendering: Debevec 1998). Before: direct_light and what lights indirectly.
// After: resolve (first hits), second_rays (catchers in mirrors and glass).
#pragma once

#include "renderer/foveation/radiance_buffer.h"
#include "renderer/tiles/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

constexpr float kSnapToOne = 0x1p-9f;  // below what 8 bits show: the feed must stay as it was, bit for bit
constexpr float kPi = 3.14159265f;

// E_with / E_without where there is light to compare, clamped and snapped.
HWY_INLINE VF catcher_ratio(VF with_objects, VF without, float smallest) {
  const VF one = set(1.0f);
  const VF ratio = hn::Min(hn::Div(with_objects, hn::Max(without, set(1e-30f))), set(kLargestRatio));
  const MF keep =
      hn::Or(hn::Le(without, set(smallest)), hn::Lt(hn::Abs(hn::Sub(ratio, one)), set(kSnapToOne)));
  return hn::IfThenElse(keep, one, ratio);
}

// Of hits [slot, slot + kLanes) that are lit as catchers; short rays count where they were traced.
HWY_INLINE V3 catcher_ratios(const ShadingInputs& shading, const HitBatch& hits, int slot,
                             bool occlusion_traced) {
  const VF zero = hn::Zero(kF), one = set(1.0f);
  const VF open = occlusion_traced ? hn::Max(load(&hits.open[slot]), zero) : one;
  const VF open_without = occlusion_traced ? hn::Max(load(&hits.open_without[slot]), zero) : one;
  const bool probes = shading.catcher_probes != nullptr;
  const auto ratio = [&](const Lane<float>& with_objects, const Lane<float>& without,
                         const Lane<float>& around, const Lane<float>& around_without, std::size_t channel)
                         HWY_ATTR {
                           const VF pi = set(kPi), ambient = set(kPi * shading.ambient[channel]);
                           const VF all = probes ? hn::Mul(pi, load(&around[slot])) : ambient;
                           const VF all_without = probes ? hn::Mul(pi, load(&around_without[slot])) : ambient;
                           return catcher_ratio(hn::MulAdd(all, open, load(&with_objects[slot])),
                                                hn::MulAdd(all_without, open_without, load(&without[slot])),
                                                shading.smallest_irradiance[channel]);
                         };
  return {ratio(hits.direct.x, hits.direct_without.x, hits.indirect.x, hits.indirect_without.x, 0),
          ratio(hits.direct.y, hits.direct_without.y, hits.indirect.y, hits.indirect_without.y, 1),
          ratio(hits.direct.z, hits.direct_without.z, hits.indirect.z, hits.indirect_without.z, 2)};
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
