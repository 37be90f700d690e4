// The directions in which every probe of a frame looks: a spherical Fibonacci set (Keinert et al. 2015),
// turned as a whole by a rotation that the frame's time selects. All probes share them, so their weights in
// each node of an irradiance map are worked out once for a frame.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace herr {

// Direction i of n, unit.
glm::dvec3 fibonacci_direction(int i, int n);
// A rotation, uniform over all rotations for uniform keys (Shoemake 1992).
glm::dquat rotation_of(std::uint32_t key);

struct ProbeDirections {
  // Per ray.
  std::vector<float> x, y, z;
  // Per direction of the irradiance map a run of (ray, weight): the rays within 90 degrees, cosine weights
  // that sum to 1.
  struct Weight {
    std::int32_t ray;
    float weight;
  };
  std::vector<Weight> weights;
  std::vector<std::int32_t> first_weight;  // per direction, then the end
  // Per weight what the ray brings, R, G, B, where it meets nothing; empty: the environment it sees, times
  // its weight (environment/sky_of_rays.h).
  struct SkyShare {
    float light[3];
  };
  std::vector<SkyShare> sky;
  std::vector<float> sky_nodes;  // with a sky, all of it: R, G, B, unused for each node of the irradiance map
  std::uint32_t key = 0;         // random numbers of the frame

  // Allocates for `rays`, kFewestProbeRays ... kMostProbeRays (renderer/render_settings.h).
  void allocate(int rays, int directions);
  // New frame, without a sky; `node_directions` are those of the irradiance map. No allocation.
  void aim(std::uint32_t frame_key, const std::vector<glm::dvec3>& node_directions);
  int rays() const { return static_cast<int>(x.size()); }
};

}  // namespace herr
