#include "renderer/feed/camera_feed.h"

#include <algorithm>

namespace herr {

const CameraImage* at_least_2x2(const CameraImage& image, CameraImage& storage) {
  if (image.width_px >= 2 && image.height_px >= 2) return &image;
  storage.width_px = std::max(2, image.width_px);
  storage.height_px = std::max(2, image.height_px);
  storage.rgba_half.resize(4 * static_cast<std::size_t>(storage.width_px) *
                           static_cast<std::size_t>(storage.height_px));
  for (int y = 0; y < storage.height_px; ++y) {
    for (int x = 0; x < storage.width_px; ++x) {
      const auto from = static_cast<std::size_t>(std::min(y, image.height_px - 1)) *
                            static_cast<std::size_t>(image.width_px) +
                        static_cast<std::size_t>(std::min(x, image.width_px - 1));
      const auto to = static_cast<std::size_t>(y) * static_cast<std::size_t>(storage.width_px) +
                      static_cast<std::size_t>(x);
      std::copy_n(&image.rgba_half[4 * from], 4, &storage.rgba_half[4 * to]);
    }
  }
  return &storage;
}

}  // namespace herr
