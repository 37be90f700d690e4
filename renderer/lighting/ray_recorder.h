// Copies of the rays of some tiles, by kind, in the order in which they were made: what `bench` sends through
// bare Embree packets to learn how fast this frame's own rays could go.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace herr {

enum class RayKind : std::uint8_t { primary, shadow, catcher_shadow, mirror, mirror_shadow };
inline constexpr std::size_t kRayKinds = 5;

struct RecordedRays {
  std::vector<float> ox, oy, oz, dx, dy, dz;
  std::size_t size() const { return ox.size(); }
};

struct RayRecorder {
  std::array<RecordedRays, kRayKinds> rays;

  void add(RayKind kind, float ox, float oy, float oz, float dx, float dy, float dz) {
    RecordedRays& r = rays[static_cast<std::size_t>(kind)];
    r.ox.push_back(ox), r.oy.push_back(oy), r.oz.push_back(oz);
    r.dx.push_back(dx), r.dy.push_back(dy), r.dz.push_back(dz);
  }
};

}  // namespace herr
