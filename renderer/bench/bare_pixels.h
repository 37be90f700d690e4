// Pixels through a bare kernel - fetch, blend, store - with coordinates that were computed beforehand: the
// speed of light that `bench` holds the viewport stage against. The counterpart for rays is bare_rays.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/viewports/viewport_job.h"

namespace herr {

struct PrecomputedPixels {
  std::vector<std::uint32_t> polar_offset, camera_offset;   // texels
  std::vector<float> polar_x, polar_y, camera_x, camera_y;  // weights
  std::vector<std::uint16_t> out;                           // 4 per pixel
  std::size_t count() const { return polar_offset.size(); }
};
// Appends the coordinates of one block row of kBlockColumns pixels starting at (x, y).
using PrecomputePixels = void (*)(const ViewportJob&, int x, int y, PrecomputedPixels&);
PrecomputePixels precompute_pixels_for(Isa isa);
using CompositePrecomputed = void (*)(const ViewportJob&, PrecomputedPixels&, std::size_t first,
                                      std::size_t count);
CompositePrecomputed composite_precomputed_for(Isa isa);

}  // namespace herr
