#include "renderer/viewport_image.h"

namespace herr {

std::size_t padded_row(int width_px) {
  constexpr std::size_t kTexelsPerBlock = 16;
  return (static_cast<std::size_t>(width_px) + kTexelsPerBlock - 1) / kTexelsPerBlock * kTexelsPerBlock;
}

void ViewportImage::resize(int width, int height) {
  width_px = width;
  height_px = height;
  row_stride = padded_row(width);
  rgba_half.resize(4 * row_stride * static_cast<std::size_t>(height));
}

}  // namespace herr
