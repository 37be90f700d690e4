// What a look-up of indirect light reads: plain pointers into one set of probes, as of the last frame.
// Before: probe_volume keeps and publishes it. After: the kernels of probe_lookup-inl.h.
#pragma once

#include <cstdint>

#include "renderer/probes/octahedral_map.h"

namespace herr {

inline constexpr int kLightNodes = 8, kDistanceNodes = 32;
using LightNodes =
    OctahedralNodes<kLightNodes>;  // mean incoming radiance per direction of the surface's normal
using DistanceNodes = OctahedralNodes<kDistanceNodes>;  // inverse distance to geometry per direction of sight

// A node of light is three floats of 21 bits in two words: r and g in the upper 21 bits of each,
// b in the lower 11 bits of the first and the lower 10 of the second. 13 bits of mantissa, no
// sign, the range of float.
inline constexpr int kLightWords = 2;

// A node of distance is one word: low 16 bits the inverse distance, high 16 bits its deviation, both in units
// of 1 / (65535 * nearest). Distances are sums of absolute coordinates (|x| + |y| + |z|): their inverse is
// linear in the octahedral map's triangles where a plane is seen.
inline constexpr float kDistanceSteps = 65535.0f;

struct ProbeView {
  float lower[3] = {};  // of the grid, metres from the anchor
  float inverse_spacing[3] = {};
  std::int32_t counts[3] = {1, 1, 1};
  float nearest = 1;                         // metres: a distance of this and less is stored as 1 / nearest
  float normal_bias_m = 0;                   // the point that a probe must see lies this far off the surface,
  float view_bias_m = 0;                     // and this far towards the viewer
  float tolerance_m = 0;                     // what lies this little behind what the probe sees is in sight
  const float* places = nullptr;             // per probe x, y, z (metres from `lower`), 1 = usable or 0
  const std::uint32_t* distances = nullptr;  // per probe DistanceNodes::kCount words
  const std::uint32_t* light = nullptr;      // per probe LightNodes::kCount * kLightWords words
  const float* sky = nullptr;  // an open sky at LightNodes::kCount nodes, R, G, B, unused; or none
};

}  // namespace herr
