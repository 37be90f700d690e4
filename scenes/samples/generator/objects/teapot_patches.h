// The control points of the Utah teapot: Martin Newell, University of Utah, 1975 (32 patches as published
// with the bottom that Frank Crow added, IEEE CG&A 7(1), 1987). Units and axes are the published ones: z is
// up. The body, rim, lid and bottom were drawn as quarter turns of a profile, so rings of control points are
// stored as (radius, height); handle and spout are symmetric in y and stored as their half with y <= 0.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace herr::samples {

// One ring of control points around the axis. A quarter of it is (r, 0), (r, t), (t, r), (0, r), where
// t = tangent * r: Newell used 0.56 for the arc of a circle, 0.5625 where he rounded to 0.45 on the knob.
struct TeapotRing {
  float radius = 0.0f, height = 0.0f, tangent = 0.56f;
};

// Four rings make four patches, one per quarter turn; the profiles run from the outside's bottom to its top
// (d/du around, d/dv along the profile) or the reverse: see teapot.cpp.
using TeapotProfile = std::array<TeapotRing, 4>;

inline constexpr std::array<TeapotProfile, 6> kTeapotProfiles{{
    {{{1.4f, 2.4f}, {1.3375f, 2.53125f}, {1.4375f, 2.53125f}, {1.5f, 2.4f}}},  // rim
    {{{1.5f, 2.4f}, {1.75f, 1.875f}, {2.0f, 1.35f}, {2.0f, 0.9f}}},            // upper body
    {{{2.0f, 0.9f}, {2.0f, 0.45f}, {1.5f, 0.225f}, {1.5f, 0.15f}}},            // lower body
    {{{0.0f, 3.15f}, {0.8f, 3.15f, 0.5625f}, {0.0f, 2.85f}, {0.2f, 2.7f}}},    // knob
    {{{0.2f, 2.7f}, {0.4f, 2.55f}, {1.3f, 2.55f}, {1.3f, 2.4f}}},              // lid
    {{{1.5f, 0.15f}, {1.5f, 0.075f}, {1.425f, 0.0f}, {0.0f, 0.0f}}},           // bottom
}};

// One row across a tube: inner edge (y = 0), the same at y = -width, outer edge at y = -width, and at y = 0.
struct TeapotTubeRow {
  float inner_x = 0.0f, inner_z = 0.0f, outer_x = 0.0f, outer_z = 0.0f, width = 0.0f;
};

using TeapotTube = std::array<TeapotTubeRow, 4>;

inline constexpr std::array<TeapotTube, 4> kTeapotTubes{{
    // handle, from the top to the lower end
    {{{-1.6f, 2.025f, -1.5f, 2.25f, 0.3f},
      {-2.3f, 2.025f, -2.5f, 2.25f, 0.3f},
      {-2.7f, 2.025f, -3.0f, 2.25f, 0.3f},
      {-2.7f, 1.8f, -3.0f, 1.8f, 0.3f}}},
    {{{-2.7f, 1.8f, -3.0f, 1.8f, 0.3f},
      {-2.7f, 1.575f, -3.0f, 1.35f, 0.3f},
      {-2.5f, 1.125f, -2.65f, 0.9375f, 0.3f},
      {-2.0f, 0.9f, -1.9f, 0.6f, 0.3f}}},
    // spout, from the body to the mouth
    {{{1.7f, 1.425f, 1.7f, 0.6f, 0.66f},
      {2.6f, 1.425f, 3.1f, 0.825f, 0.66f},
      {2.3f, 2.1f, 2.4f, 2.025f, 0.25f},
      {2.7f, 2.4f, 3.3f, 2.4f, 0.25f}}},
    {{{2.7f, 2.4f, 3.3f, 2.4f, 0.25f},
      {2.8f, 2.475f, 3.525f, 2.49375f, 0.25f},
      {2.9f, 2.475f, 3.45f, 2.5125f, 0.15f},
      {2.8f, 2.4f, 3.2f, 2.4f, 0.15f}}},
}};

}  // namespace herr::samples
