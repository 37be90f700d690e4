// A red circle around the gaze direction, drawn into a finished viewport (paper, Figure 3).
#pragma once

#include <glm/vec3.hpp>

#include "renderer/viewport_image.h"
#include "sessions/format/display_profile.h"

namespace herr {

// Ring of 1 degree radius; `gaze_in_eye` is a direction in the eye's space. Nothing is
// drawn when it lies outside.
void draw_gaze_marker(const Viewport& viewport, const glm::dvec3& gaze_in_eye, ViewportImage& image);

}  // namespace herr
