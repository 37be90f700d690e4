#include "scenes/samples/generator/pictures/picture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <glm/common.hpp>
#include <stdexcept>

namespace herr::samples {

Picture paint(int width_px, int height_px, const std::function<glm::vec3(const glm::vec2& uv)>& colour) {
  Picture picture{width_px, height_px, {}};
  picture.rgb.reserve(3 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / glm::vec2(width_px, height_px);
      const glm::vec3 c = glm::clamp(colour(uv), 0.0f, 1.0f);
      for (int channel = 0; channel < 3; ++channel) {
        picture.rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0f * c[channel])));
      }
    }
  }
  return picture;
}

std::vector<std::uint8_t> encode_png(const Picture& picture) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create("png", &memory);
  if (!output) throw std::runtime_error("cannot encode PNG: " + OIIO::geterror());
  const OIIO::ImageSpec spec(picture.width_px, picture.height_px, 3, OIIO::TypeDesc::UINT8);
  if (!output->open("memory.png", spec) || !output->write_image(OIIO::TypeDesc::UINT8, picture.rgb.data()) ||
      !output->close()) {
    throw std::runtime_error("cannot encode PNG: " + output->geterror());
  }
  return bytes;
}

}  // namespace herr::samples
