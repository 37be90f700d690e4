// What rays of probes that meet nothing bring of an environment picture. Before: the frame's directions and
// their weights. After: probe_updates/ adds it to what the other rays met.
// A few dozen rays tell little of a picture with suns or lamps. Whatever they miss of the light that the
// whole picture sends to a node, those that stand for it bring more: where none meets anything, the node
// receives exactly what it should, and noise is left where something hides a part of the sky. A ratio
// estimator: Cochran, "Sampling Techniques", 1977, chapter 6.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "renderer/environment/filtered_environment.h"
#include "renderer/probes/probe_rays.h"

namespace herr {

// Fills ProbeDirections::sky and sky_nodes for rays that were aimed at `node_directions`, one for each
// direction of LightNodes, the picture turned by `turn`. No
// allocation after the first call.
void aim_sky(ProbeDirections& directions, const std::vector<glm::dvec3>& node_directions,
             const FilteredEnvironment& environment, float turn);

}  // namespace herr
