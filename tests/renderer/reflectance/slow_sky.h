// An environment picture as the slow path tracer takes it: what exceeds eight times its mean, texel by texel,
// and the rest, which is so even that directions drawn by its brightness tell it with little noise.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "scenes/model/scene.h"

namespace herr::test {

// Directions in proportion to the brightness of a picture's texels.
class PictureDirections {
 public:
  explicit PictureDirections(EnvironmentImage picture);
  glm::dvec3 draw(const glm::dvec2& random) const;
  double density(const glm::dvec3& direction) const;       // per steradian
  glm::dvec3 radiance(const glm::dvec3& direction) const;  // bilinear

 private:
  EnvironmentImage picture_;
  std::vector<double> rows_, columns_;  // sums up to each, from 0 to 1; columns of each row
  std::vector<double> densities_;       // of each texel
};

// What a texel of the picture adds to it where bilinear look-ups show it: from its middle, where it is
// `radiance`, to nothing a texel further in each direction.
struct BrightTexel {
  int column = 0, row = 0;
  glm::dvec3 direction;    // of its middle
  glm::dvec3 radiance;     // there
  double solid_angle = 0;  // integral of its weight over directions
};

class SlowSky {
 public:
  explicit SlowSky(const EnvironmentImage& picture);

  PictureDirections whole;
  std::vector<BrightTexel> bright;  // these and `rest` make `whole`
  PictureDirections rest;
  double texel_rad = 0;  // height of a texel

  struct Point {
    glm::dvec3 direction;
    double solid_angle;  // times the texel's weight there
  };
  // steps x steps places that stand for `texel`.
  void points_of(const BrightTexel& texel, int steps, std::vector<Point>& points) const;

 private:
  static EnvironmentImage take_bright(const EnvironmentImage& picture, std::vector<BrightTexel>& bright);
  int width_ = 0, height_ = 0;
};

}  // namespace herr::test
