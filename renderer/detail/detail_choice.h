// Which form of a mesh a frame shows: the coarsest whose error stays below a share of a sample (the setting
// detail_error) where the eye looks at it. A pure function of view and former choice. Before: this frame's
// eyes and gaze. After: embree_scene places the chosen mesh.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

namespace herr {

// What one eye sees how finely.
struct DetailEye {
  glm::dvec3 position{0.0};         // in the world
  glm::dvec3 gaze{0.0, 0.0, -1.0};  // unit, in the world
  double samples_per_deg = 200;     // straight at the gaze
  // What the display can show; of viewports the finest that the eye has.
  double most_samples_per_deg = std::numeric_limits<double>::infinity();
  bool foveated = true;  // falls off as 1 / (1 + eccentricity in degrees); false: the same everywhere
};

// An instance's bounding ball in the world, and metres in the world per metre of object space (the largest
// stretch of its matrix).
struct DetailBall {
  glm::dvec3 centre{0.0};
  double radius_m = 0;
  double scale = 1;
};

// A coarser form is taken only when its error is this share of what is allowed: between the two a choice
// stays as it was, so that a resting or trembling head does not make an object change back and forth.
inline constexpr double kCoarserShare = 0.7;

// Samples of the eye that one metre of error takes at the nearest point of the ball, where that point is seen
// at best: at the smallest eccentricity of the ball. Infinite within the ball.
double samples_per_metre(const DetailEye& eye, const DetailBall& ball);

// The level for this frame: 0 is the full mesh, i the i-th of `errors_m` (ascending, object space). `former`:
// of the last frame, -1 for none. `most_samples`: that it may lie off; 0: the full mesh.
int detail_level(std::span<const float> errors_m, std::span<const DetailEye> eyes, const DetailBall& ball,
                 int former, double most_samples);

}  // namespace herr
