// How a frame without foveation is divided, and which of its tiles no eye would see.
#include <algorithm>

#include "renderer/frame/renderer_impl.h"
#include "sessions/format/covered_by_focus.h"

namespace herr {

std::vector<PixelTile> Renderer::Impl::pixel_tiles() const {
  std::vector<PixelTile> tiles;
  if (plan.polar) return tiles;
  for (std::size_t i = 0; i < profile.viewports.size(); ++i) {
    const Viewport& v = profile.viewports[i];
    for (int y = 0; y < v.height_px; y += kTileSide) {
      for (int x = 0; x < v.width_px; x += kTileSide) {
        tiles.push_back({static_cast<int>(i), x, y, std::min(x + kTileSide, v.width_px),
                         std::min(y + kTileSide, v.height_px)});
      }
    }
  }
  return tiles;
}

// A tile is covered when its four corners are: what covers it is a rectangle.
void Renderer::Impl::find_covered_tiles() {
  covered_tiles.clear();
  if (plan.polar || settings.covered_pixels) return;
  for (const PixelTile& tile : pixel_tiles()) {
    const auto index = static_cast<std::size_t>(tile.viewport);
    const Viewport& v = profile.viewports[index];
    bool covered = true;
    for (const int x : {tile.x0, tile.x1}) {
      for (const int y : {tile.y0, tile.y1}) {
        covered = covered &&
                  covered_by_focus(profile, index, v.tan_left + x * (v.tan_right - v.tan_left) / v.width_px,
                                   v.tan_up - y * (v.tan_up - v.tan_down) / v.height_px);
      }
    }
    covered_tiles.push_back(covered ? 1 : 0);
  }
}

std::vector<PixelTile> Renderer::pixel_tiles() const {
  return impl_->pixel_tiles();
}

}  // namespace herr
