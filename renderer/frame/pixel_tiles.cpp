// How a frame without foveation is divided, and which of its tiles no eye would see.
#include <algorithm>

#include "renderer/frame/renderer_impl.h"
#include "sessions/format/covered_by_focus.h"

namespace herr {
namespace {

constexpr int kFilterReach = 2;  // rays: bicubic
constexpr int kBlendReach = 1;   // pixels, at most a ray each: blended views interpolate the context

// Whether one focus viewport covers a tile and as many rays around it as a filter may read. What it covers is
// a rectangle: the four corners tell. Several together need not cover what lies between corners.
bool covered_by_one(const DisplayProfile& profile, const PixelTile& tile, double scale, int reach) {
  const Viewport& own = profile.viewports[static_cast<std::size_t>(tile.viewport)];
  const double per_x = (own.tan_right - own.tan_left) / rays_along(own.width_px, scale),
               per_y = (own.tan_up - own.tan_down) / rays_along(own.height_px, scale);
  DisplayProfile pair;
  for (const Viewport& focus : profile.viewports) {
    pair.viewports = {own, focus};
    bool covered = focus.focus;
    for (const int x : {tile.x0 - reach, tile.x1 + reach}) {
      for (const int y : {tile.y0 - reach, tile.y1 + reach}) {
        covered = covered && covered_by_focus(pair, 0, own.tan_left + x * per_x, own.tan_up - y * per_y);
      }
    }
    if (covered) return true;
  }
  return false;
}

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

void Renderer::Impl::find_covered_tiles() {
  covered_tiles.clear();
  if (plan.polar || settings.covered_pixels) return;
  const int reach = kFilterReach + (settings.blended_view == Blend::off ? 0 : kBlendReach);
  for (const PixelTile& tile : pixel_tiles()) {
    covered_tiles.push_back(covered_by_one(profile, tile, settings.scale, reach) ? 1 : 0);
  }
}

std::vector<PixelTile> Renderer::pixel_tiles() const {
  return impl_->pixel_tiles();
}

}  // namespace herr
