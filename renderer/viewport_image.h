// One finished viewport: linear-light RGBA, premultiplied, as IEEE half bit patterns, rows from the top.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace herr {

// Texels from row to row of a picture of that width: kernels store whole blocks.
std::size_t padded_row(int width_px);

struct ViewportImage {
  int width_px = 0, height_px = 0;
  // Over a camera feed alpha is 1; without one it is the coverage by virtual objects. Rows start at multiples
  // of row_stride texels (>= width_px, padded so that kernels store whole vectors).
  std::size_t row_stride = 0;
  float exposure = 1;  // what it is shown with: 8-bit pictures have white where a value times this is 1
  std::vector<std::uint16_t> rgba_half;  // 4 * row_stride * height_px

  void resize(int width, int height);
  const std::uint16_t* row(int y) const {
    return rgba_half.data() + 4 * row_stride * static_cast<std::size_t>(y);
  }
  std::uint16_t* row(int y) { return rgba_half.data() + 4 * row_stride * static_cast<std::size_t>(y); }
};

}  // namespace herr
