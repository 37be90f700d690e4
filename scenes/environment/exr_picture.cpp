#include "scenes/environment/exr_picture.h"

#include <algorithm>
#include <cstdint>

#include "scenes/environment/environment_limits.h"
#include "scenes/environment/exr_layers.h"
#include "scenes/environment/exr_scanlines.h"
#include "sessions/files/input_error.h"
#include "sessions/pictures/exr_header.h"
#include "sessions/pictures/header_bytes.h"
#include "sessions/pictures/image_format.h"

namespace herr {
namespace {

void remark_windows(const ExrLayout& layout, const std::filesystem::path& file,
                    std::vector<std::string>& remarks) {
  const ExrWindow &data = layout.data, &display = layout.display;
  if (data.left > display.right || data.right < display.left || data.top > display.bottom ||
      data.bottom < display.top) {
    throw InputError(file, 0, "is an EXR whose data window lies outside its display window",
                     "make them agree: oiiotool IN.exr --fullpixels -o OUT.exr");
  }
  if (data.left > display.left || data.right < display.right || data.top > display.top ||
      data.bottom < display.bottom) {
    remarks.push_back("its data window covers a part of the picture; the rest is black");
  }
}

}  // namespace

EnvironmentImage read_exr_picture(std::string_view bytes, const std::filesystem::path& file,
                                  std::vector<std::string>& remarks) {
  HeaderBytes header(file, bytes);
  recognised_format(file, header.first(8));
  const ExrLayout layout = read_exr_layout(header);
  if (layout.cube_map) {
    throw InputError(file, 0, "is a cube map by its attribute envmap",
                     "convert it to an equirectangular picture");
  }
  const ExrWindow &data = layout.data, &display = layout.display;
  check_environment_size(file, display.width(), display.height());
  remark_windows(layout, file, remarks);
  const std::array<std::size_t, 3> channels = environment_channels(layout, file, remarks);
  if (layout.other_primaries)
    remarks.push_back("its chromaticities are not used: colours are taken as sRGB's");

  EnvironmentImage image{static_cast<int>(display.width()), static_cast<int>(display.height()), 0, {}};
  const auto width = static_cast<std::size_t>(display.width());
  image.rgba.resize(4 * width * static_cast<std::size_t>(display.height()));
  const std::int64_t first = std::max(data.left, display.left), last = std::min(data.right, display.right);
  std::int64_t changed = 0;
  read_exr_scanlines(bytes, layout, channels, file, [&](std::int32_t y, const float* rgb) {
    const std::size_t row = width * static_cast<std::size_t>(std::int64_t{y} - display.top);
    float* texel = &image.rgba[4 * (row + static_cast<std::size_t>(first - display.left))];
    const float* from = rgb + 3 * (first - data.left);
    for (std::int64_t x = first; x <= last; ++x, texel += 4, from += 3) {
      for (int c = 0; c < 3; ++c) texel[c] = radiance_in_range(double{from[c]}, changed);
    }
  });
  if (changed > 0) remarks.push_back(range_remark(changed));
  return image;
}

}  // namespace herr
