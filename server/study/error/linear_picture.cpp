#include "server/study/error/linear_picture.h"

#include "server/output/srgb_table.h"

namespace herr {

void read_viewport(const ViewportImage& image, LinearPicture& out) {
  out.width_px = image.width_px;
  out.height_px = image.height_px;
  for (auto& plane : out.plane) plane.resize(out.pixels());
  const auto width = static_cast<std::size_t>(image.width_px);
  for (int y = 0; y < image.height_px; ++y) {
    const std::uint16_t* texel = image.row(y);
    const std::size_t first = width * static_cast<std::size_t>(y);
    for (std::size_t i = first; i < first + width; ++i, texel += 4) {
      for (std::size_t c = 0; c < 3; ++c) out.plane[c][i] = float_from_half(texel[c]) * image.exposure;
    }
  }
}

void limit_to_white(LinearPicture& picture) {
  for (auto& plane : picture.plane) {
    // NaN is not above 0.
    for (float& value : plane) value = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
  }
}

}  // namespace herr
