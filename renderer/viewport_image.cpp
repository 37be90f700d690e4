#include "renderer/viewport_image.h"

namespace herr {

void ViewportImage::resize(int width, int height) {
  constexpr std::size_t kTexelsPerBlock = 16;  // kernels write whole blocks of 16 pixels
  width_px = width;
  height_px = height;
  row_stride = (static_cast<std::size_t>(width) + kTexelsPerBlock - 1) / kTexelsPerBlock * kTexelsPerBlock;
  rgba_half.resize(4 * row_stride * static_cast<std::size_t>(height));
}

}  // namespace herr
