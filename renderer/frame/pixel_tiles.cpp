// How a frame without foveation is divided, and which of its tiles no eye would see.
#include <algorithm>

#include "renderer/frame/renderer_impl.h"
#include "sessions/format/covered_by_focus.h"

namespace herr {
namespace {

constexpr int kFilterReach = 2;  // rays: bicubic

}  // namespace

std::vector<PixelTile> Renderer::Impl::pixel_tiles() const {
  std::vector<PixelTile> tiles;
  if (plan.polar) return tiles;
  for (std::size_t i = 0; i < profile.viewports.size(); ++i) {
    const int width = rays_along(profile.viewports[i].width_px, settings.scale),
              height = rays_along(profile.viewports[i].height_px, settings.scale);
    for (int y = 0; y < height; y += kTileSide) {
      for (int x = 0; x < width; x += kTileSide) {
        tiles.push_back(
            {static_cast<int>(i), x, y, std::min(x + kTileSide, width), std::min(y + kTileSide, height)});
      }
    }
  }
  return tiles;
}

// A tile is covered when its four corners are, and as many rays around it as a filter may read: what covers
// it is a rectangle.
void Renderer::Impl::find_covered_tiles() {
  covered_tiles.clear();
  if (plan.polar || settings.covered_pixels) return;
  for (const PixelTile& tile : pixel_tiles()) {
    const auto index = static_cast<std::size_t>(tile.viewport);
    const Viewport& v = profile.viewports[index];
    const double per_x = (v.tan_right - v.tan_left) / rays_along(v.width_px, settings.scale),
                 per_y = (v.tan_up - v.tan_down) / rays_along(v.height_px, settings.scale);
    bool covered = true;
    for (const int x : {tile.x0 - kFilterReach, tile.x1 + kFilterReach}) {
      for (const int y : {tile.y0 - kFilterReach, tile.y1 + kFilterReach}) {
        covered = covered && covered_by_focus(profile, index, v.tan_left + x * per_x, v.tan_up - y * per_y);
      }
    }
    covered_tiles.push_back(covered ? 1 : 0);
  }
}

std::vector<PixelTile> Renderer::pixel_tiles() const {
  return impl_->pixel_tiles();
}

}  // namespace herr
