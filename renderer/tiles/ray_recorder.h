// Copies of the rays of some tiles, by kind, in the order in which they were made: what `bench` sends through
// bare Embree packets to learn how fast this frame's own rays could go.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "renderer/ray_kind.h"

namespace herr {

// Rays in structure of arrays. An idle lane of a packet is kept as a gap (ox is NaN), so that the frame's own
// packets can be traced again.
struct RecordedRays {
  std::vector<float> ox, oy, oz, dx, dy, dz;
  std::vector<std::uint32_t> footprint;  // Embree's id of the ray: how wide it is
  std::vector<float> chance;             // Embree's time of the ray: what decides whether it meets voxels

  std::size_t size() const { return ox.size(); }  // gaps included
  bool is_gap(std::size_t i) const { return std::isnan(ox[i]); }
  void add(float o_x, float o_y, float o_z, float d_x, float d_y, float d_z, std::uint32_t id, float time) {
    ox.push_back(o_x), oy.push_back(o_y), oz.push_back(o_z);
    dx.push_back(d_x), dy.push_back(d_y), dz.push_back(d_z);
    footprint.push_back(id), chance.push_back(time);
  }
  // The same rays without gaps.
  RecordedRays dense() const {
    RecordedRays out;
    for (std::size_t i = 0; i < size(); ++i) {
      if (!is_gap(i)) out.add(ox[i], oy[i], oz[i], dx[i], dy[i], dz[i], footprint[i], chance[i]);
    }
    return out;
  }
};

struct RayRecorder {
  std::array<RecordedRays, kRayKinds> rays;

  void add(RayKind kind, float ox, float oy, float oz, float dx, float dy, float dz, std::uint32_t id,
           float time) {
    rays[static_cast<std::size_t>(kind)].add(ox, oy, oz, dx, dy, dz, id, time);
  }
  void add_gap(RayKind kind) { add(kind, std::numeric_limits<float>::quiet_NaN(), 0, 0, 0, 0, 0, 0, 0); }
};

}  // namespace herr
