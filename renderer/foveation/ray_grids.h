// This frame's ray grids: one per eye (log-polar, around its gaze) or one per viewport (planar, without
// foveation). Before: the frame's pose and gaze. After: tile tracing writes the grids' radiance buffers.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "renderer/feed/feed_view.h"
#include "renderer/foveation/edge_places.h"
#include "renderer/foveation/gaze_frame.h"
#include "renderer/foveation/polar_samples.h"
#include "renderer/foveation/radiance_buffer.h"
#include "renderer/pixel_pass.h"
#include "sessions/format/display_profile.h"
#include "sessions/format/pose.h"

namespace herr {

// Everything about one eye that rays and viewports of a frame need.
struct EyeView {
  Pose anchored_from_eye;  // eye in the scene, relative to the anchor
  GazeFrame gaze;          // in eye space
  double theta_max_deg = 0;
};

inline constexpr int kMaxFrusta = 64;

// The inward normals of a viewport's frustum, in anchor space.
struct FrustumNormals {
  float normal[4][3];
};

// What is the same for all tiles of one eye (or one viewport) in one frame.
struct RayGrid {
  bool polar = true;
  float origin[3];  // eye, metres from the anchor
  float right[3], up[3],
      gaze[3];  // anchor space; polar: gaze frame; planar: the viewport's axes (gaze = forward)
  const PolarSamples* samples = nullptr;
  const EdgePlaces* edge_places = nullptr;  // where further rays pass through samples at edges; null: none do
  std::array<FrustumNormals, kMaxFrusta> frusta;
  int frustum_count = 0;
  float tan_left = 0, tan_up = 0, step_x = 0,
        step_y = 0;  // planar: tangents at the upper left corner, per ray
  float finest_pixel_rad =
      0;  // polar: between pixels in the middle of the eye's finest viewport; planar: between its rays
  float ray_width = 1;  // of the cones of rays against their samples
  TexelSink sink;
  const FeedInScene* feed = nullptr;  // what mirrors and glass show of the camera's image; null: nothing
  std::uint32_t key = 0;              // frame, eye and seed
  // Planar: rays pass through place (x, y) of each pixel, shifted by numbers of the pixel and this key.
  bool jitter = false;
  float jitter_x = 0.5f, jitter_y = 0.5f;
  std::uint32_t jitter_key = 0;
};

// Random-number key of a frame, by its time since the session's start, and eye.
std::uint32_t frame_key(TimeNs since_start_ns, int eye, std::uint32_t seed);
// That of a camera outside the headset: none of an eye.
std::uint32_t outside_key(TimeNs since_start_ns, std::uint32_t seed);

// Fill `grid` for an eye's polar buffer, or for one viewport's planar one. `samples` and `buffer` must
// outlive it; of the eye's viewports (kMaxFrusta at most) those that lie within another are left out.
void set_polar_grid(const EyeView& view, std::span<const Viewport> viewports, Eye eye,
                    const PolarSamples& samples, RadianceBuffer& buffer, std::uint32_t key, RayGrid& grid);
void set_planar_grid(const EyeView& view, const Viewport& viewport, double scale, RadianceBuffer& buffer,
                     std::uint32_t key, RayGrid& grid);

// Rays of a planar grid through the places that `pass` asks for; `viewport` keeps viewports apart.
void set_jitter(const PixelPass& pass, int viewport, RayGrid& grid);

// Rays along so many pixels of a viewport without foveation (RenderSettings::scale).
int rays_along(int pixels, double scale);

}  // namespace herr
