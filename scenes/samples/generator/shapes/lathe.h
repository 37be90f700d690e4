// Surfaces of revolution about the y axis, turned from a profile as on a lathe.
#pragma once

#include <vector>

#include "scenes/samples/generator/shapes/mesh.h"

namespace herr::samples {

// A point of the profile. The curve through the points is smooth (Catmull-Rom) except at sharp ones.
struct ProfilePoint {
  float radius_m = 0.0f, height_m = 0.0f;
  bool sharp = false;
};

struct LatheOptions {
  int slices = 64;         // around the axis
  int steps_per_span = 6;  // along the profile, between two of its points
};

// The profile runs with the outside on its right: up the outer wall, down the inner one. uv: u once
// around, v from 1 at the start of the profile to 0 at its end by length.
Mesh lathe(const std::vector<ProfilePoint>& profile, const LatheOptions& options);

}  // namespace herr::samples
