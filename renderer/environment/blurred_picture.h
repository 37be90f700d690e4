// A picture as GGX lobes show it head on. Before: the picture's pyramid. After: filtered_environment keeps
// some. Source: the first factor of Karis's split sum, "Real Shading in Unreal Engine 4", 2013.
#pragma once

#include <vector>

#include "renderer/environment/picture_pyramid.h"

namespace herr {

// The picture whose pyramid is `from` as a lobe of `alpha` shows it, at `width` texels: its mean, weighed by
// the lobe of n = v = r. `width`: a power of two, from 32 to the picture's own.
SkyPicture blurred(const std::vector<SkyPicture>& from, double alpha, int width, const ParallelFor& parallel);

}  // namespace herr
