// How far a probe sees in every direction: one ray for each node of its distance map. A node keeps the
// inverse distance, exact for every plane, and as deviation how much linear interpolation may miss around it:
// 0 on planes, large along silhouettes.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "renderer/embree/embree_api.h"

namespace herr {

// Distances along `directions` (unit) from `origin` (metres from the anchor) to geometry of `mask`; infinity
// where there is none. Thread-safe.
void trace_distances(RTCScene scene, const glm::dvec3& origin, unsigned mask,
                     std::span<const glm::vec3> directions, std::vector<float>& out);

// The directions of the nodes, row by row.
const std::vector<glm::vec3>& distance_directions();

struct DistanceScratch {
  std::vector<double> inverse, misses, deviations;
};
// `distances` along distance_directions() -> the words of a distance map (probe_view.h).
void pack_distances(std::span<const float> distances, double nearest_m, DistanceScratch& scratch,
                    std::uint32_t* words);
// words <- kept * words + (1 - kept) * now, rounded: inverse distances and deviations.
void blend_distances(const std::uint32_t* now, double kept, std::uint32_t* words);

}  // namespace herr
