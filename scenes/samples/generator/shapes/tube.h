// A round tube along a curve: knots, rings, stems, rails.
#pragma once

#include <vector>

#include "scenes/samples/generator/shapes/mesh.h"

namespace herr::samples {

struct TubePoint {
  glm::vec3 centre{0.0f};
  float radius_m = 0.0f;
};

struct TubeOptions {
  int sides = 16;
  bool closed = false;  // joins the last point to the first, without a twist
  // Width and height of the cross-section relative to radius: (1, 1) is round.
  glm::vec2 flatten{1.0f};
};

// Frames are carried along the curve without rotation about it (double reflection, Wang et al. 2008).
// Open tubes are closed by flat discs. uv: u around, v along.
Mesh tube(const std::vector<TubePoint>& path, const TubeOptions& options);

}  // namespace herr::samples
