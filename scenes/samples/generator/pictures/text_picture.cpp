#include "scenes/samples/generator/pictures/text_picture.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <array>
#include <stdexcept>

namespace herr::samples {
namespace {

constexpr const char* kFont = "DejaVuSans";  // of Debian's fonts-dejavu-core

OIIO::ImageBuf wrapped(Picture& page) {
  return OIIO::ImageBuf(OIIO::ImageSpec(page.width_px, page.height_px, 3, OIIO::TypeDesc::UINT8),
                        page.rgb.data());
}

}  // namespace

Picture blank_page(int side_px) {
  const auto pixels = static_cast<std::size_t>(side_px) * static_cast<std::size_t>(side_px);
  return {side_px, side_px, std::vector<std::uint8_t>(3 * pixels, 255)};
}

void write_line(Picture& page, const std::string& text, int x_px, int y_px, int size_px) {
  constexpr std::array<float, 3> kBlack{0.0f, 0.0f, 0.0f};
  // OpenImageIO 2.4 aborts on text that leaves the picture.
  const OIIO::ROI size = OIIO::ImageBufAlgo::text_size(text, size_px, kFont);
  if (size.defined() && (x_px + size.xbegin < 0 || y_px + size.ybegin < 0 ||
                         x_px + size.xend > page.width_px || y_px + size.yend > page.height_px)) {
    throw std::runtime_error("text '" + text + "' leaves the picture");
  }
  OIIO::ImageBuf image = wrapped(page);
  if (!OIIO::ImageBufAlgo::render_text(image, x_px, y_px, text, size_px, kFont, kBlack)) {
    throw std::runtime_error("cannot write text: " + image.geterror() + " (install fonts-dejavu-core)");
  }
}

int line_width_px(const std::string& text, int size_px) {
  const OIIO::ROI size = OIIO::ImageBufAlgo::text_size(text, size_px, kFont);
  if (!size.defined()) throw std::runtime_error("cannot measure text (install fonts-dejavu-core)");
  return size.width();
}

}  // namespace herr::samples
