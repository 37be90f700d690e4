// An equirectangular picture in ever coarser forms, each half as wide as the one before. Before: the
// picture that scenes/ decoded. After: bright_sources and filtered_environment.
#pragma once

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "scenes/model/scene.h"

namespace herr {

// Linear RGB, the fourth value unused; rows from the zenith down, as EnvironmentRecord.
struct SkyPicture {
  int width = 0, height = 0;
  std::vector<std::array<float, 4>> texels;

  const std::array<float, 4>& at(int x, int y) const {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  // Towards a place of the picture, in texels (0 ... width, 0 ... height), of an unturned picture.
  glm::dvec3 direction(double x, double y) const;
  double solid_angle(int y) const;  // of each texel of a row
};

// Calls the job for each number below the count, on any thread.
using ParallelFor = std::function<void(int count, const std::function<void(int)>& job)>;

// The picture at `width` x `width` / 2 texels, the mean over each of what bilinear look-ups give; as it is
// where it has that size.
SkyPicture resampled(const EnvironmentImage& picture, int width, const ParallelFor& parallel);
// Half as wide and high, by solid angle. The width is a power of two from 4 on.
SkyPicture halved(const SkyPicture& picture);
// From `picture` down to 4 x 2 texels; rows are blurred along themselves so that a texel is nowhere narrower
// than high: near a pole many share one direction.
std::vector<SkyPicture> pyramid_of(SkyPicture picture);

}  // namespace herr
