// A lamp's light split from what hides it: unshadowed light comes from a few points near the middles of
// larger strata, each times the share of the samples in it that are seen (ratio estimators: Heitz, Hill &
// McGuire, "Combining Analytic Direct Illumination and Stochastic Shadows", 2018). Before: light records.
// After: adaptive_light-inl.h.
#pragma once

#include <span>
#include <vector>

#include "renderer/geometry/shading_scene.h"

namespace herr {

// Fills `out` (its storage is kept), one for each light; those of lights that are not adaptive say nothing.
void shading_points(std::span<const LightRecord> lights, std::vector<ShadingPoints>& out);

}  // namespace herr
