// Pictures and profiles that the tests of the encoders share.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "renderer/further_view.h"
#include "renderer/viewport_image.h"
#include "server/output/exr_encoder.h"
#include "server/output/srgb_table.h"
#include "sessions/format/display_profile.h"

namespace herr {

// Values over the whole range of finite halves, alpha in [0, 1]; rows padded by three texels of garbage.
inline ViewportImage random_picture(int width, int height, unsigned seed) {
  std::mt19937 engine(seed);
  ViewportImage image;
  image.width_px = width;
  image.height_px = height;
  image.row_stride = static_cast<std::size_t>(width) + 3;
  image.rgba_half.assign(4 * image.row_stride * static_cast<std::size_t>(height), 0x7E00);  // NaN outside
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::uint16_t* texel = image.row(y) + 4 * x;
      for (int c = 0; c < 3; ++c) texel[c] = static_cast<std::uint16_t>(engine() % 0x7C00);
      texel[3] = static_cast<std::uint16_t>(engine() % 0x3C01);
    }
  }
  return image;
}

// Two viewports per eye of the given sizes.
inline DisplayProfile small_profile(int context_px = 40, int focus_width_px = 32, int focus_height_px = 18) {
  DisplayProfile profile;
  profile.name = "small";
  for (const Eye eye : kEyes) {
    const std::string side = eye == Eye::left ? "left" : "right";
    Viewport context;
    context.name = side + "_context";
    context.eye = eye;
    context.width_px = context.height_px = context_px;
    context.tan_left = context.tan_down = -1.0;
    context.tan_right = context.tan_up = 1.0;
    Viewport focus = context;
    focus.name = side + "_focus";
    focus.focus = true;
    focus.width_px = focus_width_px;
    focus.height_px = focus_height_px;
    profile.viewports.push_back(context);
    profile.viewports.push_back(focus);
  }
  return profile;
}

inline std::vector<const ViewportImage*> pointers_to(const std::vector<ViewportImage>& pictures) {
  std::vector<const ViewportImage*> pointers;
  for (const ViewportImage& picture : pictures) pointers.push_back(&picture);
  return pointers;
}

inline void one_after_another(int count, const std::function<void(int)>& work) {
  for (int i = 0; i < count; ++i) work(i);
}

}  // namespace herr
