// Where the time of one frame went. Rows sum to the frame time; what no row covers is `other`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace herr {

enum class Stage : std::uint8_t {
  scene_update,    // lights of this frame; its plan where the scene has other traits
  acceleration,    // Embree commits (only what changed)
  probe_rays,      // rays of probes through Embree, their surfaces and light
  probe_update,    // radiance of probe rays -> light that probes have gathered
  polar_rays,      // ray generation, visibility of samples
  first_hits,      // primary rays through Embree
  surfaces,        // hit -> position, normal, material
  light_rays,      // shadow rays and direct light at first hits
  occlusion,       // short rays of ambient occlusion at first hits
  indirect_light,  // look-ups of probes at first and second hits
  second_hits,     // mirrored and refracted rays through Embree and their surfaces
  second_light,    // shadow rays and direct light at second hits
  edges,           // further rays through samples at edges, and which surfaces they meet
  resolve,         // shaded samples -> polar buffer texels
  viewports,       // polar buffer -> viewports, composite over the camera feed
  overlays,        // lines of sample density, gaze marker
  idle,            // threads waiting at the end of a parallel phase
  other,           // frame time that no other row covers
};
inline constexpr std::size_t kStageCount = 18;
// Column name without unit: "scene_update", ...
const char* name_of(Stage stage);

struct StageTimes {
  std::array<double, kStageCount> ms{};  // wall milliseconds
  double frame_ms = 0;                   // equals the sum of ms
  double commit_ms = 0;                  // of the stage acceleration: Embree's commits, 0 without any
  double views_ms = 0;                   // after the frame time: RenderedFrame::further, 0 without any
  double outside_ms = 0;                 // of these: the view from outside, 0 without one

  double& operator[](Stage s) { return ms[static_cast<std::size_t>(s)]; }
  double operator[](Stage s) const { return ms[static_cast<std::size_t>(s)]; }
};

}  // namespace herr
