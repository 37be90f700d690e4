// Half-float pixels as the tests read and write them: slow, exact, one at a time.
// Before: viewports and radiance buffers of the renderer. After: comparisons in double.
#pragma once

#include <Imath/half.h>

#include <array>
#include <cstdint>

#include "renderer/viewport_image.h"

namespace herr::test {

inline double from_half(std::uint16_t bits) {
  Imath::half h;
  h.setBits(bits);
  return static_cast<double>(static_cast<float>(h));
}

// The nearest half.
inline std::uint16_t to_half(double value) {
  return Imath::half(static_cast<float>(value)).bits();
}

// Rounding to the nearest half moves a value of at most `magnitude` (a normal number) by this at most: halfs
// have 11 significant bits.
inline double half_rounding(double magnitude) {
  return magnitude * 0x1p-11;
}

using Pixel = std::array<double, 4>;

inline Pixel pixel_at(const ViewportImage& image, int x, int y) {
  const std::uint16_t* p = image.row(y) + 4 * x;
  return {from_half(p[0]), from_half(p[1]), from_half(p[2]), from_half(p[3])};
}

// Visits every pixel of the picture, not the padding at the end of its rows.
template <typename Visit>
void for_each_pixel(const ViewportImage& image, const Visit& visit) {
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) visit(x, y, pixel_at(image, x, y));
  }
}

}  // namespace herr::test
