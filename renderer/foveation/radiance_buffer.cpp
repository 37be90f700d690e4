#include "renderer/foveation/radiance_buffer.h"

namespace herr {

void RadianceBuffer::allocate(int columns, int rows, bool coloured_ratio) {
  row_stride_ = (static_cast<std::size_t>(columns) + 3) / 4 * 4;
  constexpr std::size_t kTail = 8;  // a fetch at the very end stays inside
  const std::size_t size = 4 * (row_stride_ * static_cast<std::size_t>(rows) + kTail);
  texels_.assign(size, 0);
  ratios_.assign(coloured_ratio ? size : 0, 0);
}

}  // namespace herr
