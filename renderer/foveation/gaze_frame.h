// One eye's gaze as a coordinate frame, and how far from the gaze its viewports reach.
// Before: the sampled gaze of the session. After: ray generation and the polar -> viewport map.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "sessions/format/display_profile.h"

namespace herr {

// Orthonormal, in eye space: columns right, up, gaze. phi runs counter-clockwise from
// `right` as the eye sees it.
struct GazeFrame {
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}, gaze{0, 0, -1};
};

// The frame that the smallest rotation carries from "straight ahead" to `gaze` (any non-zero length);
// straight behind, where that is not unique, it turns about the up axis. Non-finite or zero input gives
// straight ahead.
GazeFrame gaze_frame(const glm::dvec3& gaze_in_eye);

// Eccentricity in degrees, [0, 180], of a direction of any length: atan2(|cross|, dot), accurate at both
// poles.
double eccentricity_deg(const glm::dvec3& gaze, const glm::dvec3& direction);

// Largest eccentricity in degrees of any point of this eye's viewports: corners, the farthest
// points of the borders, and 180 when a viewport contains the direction opposite to the gaze. 0
// when the eye has no viewport.
double theta_max_deg(const GazeFrame& frame, std::span<const Viewport> viewports, Eye eye);

// Four inward unit normals of a viewport's frustum in eye space (left, right, down, up).
struct FrustumPlanes {
  glm::dvec3 normal[4];
};
FrustumPlanes frustum_planes(const Viewport& viewport);

}  // namespace herr
