// A picture as errors are measured on it: linear light at the picture's exposure, white = 1, as floats.
// Colour over a camera feed is what is shown; without one it is the premultiplied colour, over black. Before:
// viewport images of a frame. After: pixel_errors, acuity_filter, flip.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "renderer/viewport_image.h"

namespace herr {

struct LinearPicture {
  int width_px = 0, height_px = 0;
  std::array<std::vector<float>, 3> plane;  // red, green, blue: width_px * height_px each, rows from the top

  std::size_t pixels() const {
    return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  }
};

// `out` keeps its storage. Values are as they are: not clamped.
void read_viewport(const ViewportImage& image, LinearPicture& out);

// Each value limited to [0, 1], as a display shows it; NaN becomes 0.
void limit_to_white(LinearPicture& picture);

}  // namespace herr
