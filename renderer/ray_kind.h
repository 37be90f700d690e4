// The kinds of rays that a frame traces, and counts of rays by kind: one list for
// kernels, bench and every report.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace herr {

enum class RayKind : std::uint8_t {
  primary,            // from the eye
  shadow,             // from first hits to lights
  catcher_shadow,     // from catchers that are in shadow to lights, past virtual objects
  mirror,             // second rays: reflection
  mirror_shadow,      // from mirrored hits to lights
  refraction,         // second rays: through transparent surfaces
  refraction_shadow,  // from what they show to lights
  occlusion,          // short rays of ambient occlusion
  catcher_occlusion,  // the same from catchers, past virtual objects
  probe,              // from probes
  probe_shadow,       // from what probes see to lights
  catcher_probe,      // the same for the probes of catchers alone, past virtual objects
  catcher_probe_shadow,
  behind,       // from the eye, on through surfaces that blend and past backs that it does not see
  edge,         // further ones from the eye through samples at edges; twice where what they meet is lit anew
  edge_shadow,  // from what those meet at the borders of shadows to lights
};
inline constexpr std::size_t kRayKinds = 16;
// Without "rays": "primary", "catcher_shadow", ...
const char* name_of(RayKind kind);

struct RayCounts {
  std::array<std::int64_t, kRayKinds> of_kind{};

  std::int64_t& operator[](RayKind kind) { return of_kind[static_cast<std::size_t>(kind)]; }
  std::int64_t operator[](RayKind kind) const { return of_kind[static_cast<std::size_t>(kind)]; }
  RayCounts& operator+=(const RayCounts& other) {
    for (std::size_t i = 0; i < kRayKinds; ++i) of_kind[i] += other.of_kind[i];
    return *this;
  }
};

}  // namespace herr
