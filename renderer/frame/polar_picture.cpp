#include "renderer/polar_picture.h"

#include <algorithm>
#include <cstring>

#include "renderer/frame/renderer_impl.h"

namespace herr {

bool thin_polar_buffer(Renderer& renderer, Eye eye, int longest_px, ViewportImage& out) {
  const Renderer::Impl& impl = renderer.internals();
  if (!impl.plan.polar) return false;
  const auto e = static_cast<std::size_t>(eye);
  const int width = impl.samples[e]->width(), height = impl.samples[e]->height();
  const int step = (std::max(width, height) + longest_px - 1) / longest_px;
  const int columns = (width + step - 1) / step, rows = (height + step - 1) / step;
  if (out.width_px != columns || out.height_px != rows) out.resize(columns, rows);
  out.exposure = impl.shown_scale();
  const RadianceBuffer& buffer = impl.buffers[e];
  for (int y = 0; y < rows; ++y) {
    const std::uint16_t* from = buffer.texels() + 4 * texel_index(buffer.row_stride(), 0, y * step);
    std::uint16_t* to = out.row(y);
    for (int x = 0; x < columns; ++x)
      std::memcpy(to + 4 * x, from + 4 * static_cast<std::size_t>(x * step), 4 * sizeof(std::uint16_t));
  }
  return true;
}

}  // namespace herr
