#include "server/output/png_encoder.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <stdexcept>
#include <string>

namespace herr {
namespace {

[[noreturn]] void refuse(const std::string& reason) {
  throw std::runtime_error("PNG encoder: " + (reason.empty() ? "unknown failure" : reason));
}

}  // namespace

void encode_png(const Srgb8Image& image, std::vector<std::uint8_t>& out, int level) {
  out.clear();
  // The proxy must outlive the output: it is declared first.
  OIIO::Filesystem::IOVecOutput proxy(out);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png", &proxy);
  if (!output) refuse(OIIO::geterror());
  OIIO::ImageSpec spec(image.width_px, image.height_px, image.channels, OIIO::TypeDesc::UINT8);
  spec.attribute("png:compressionLevel", level);
  spec.attribute("oiio:ColorSpace", std::string("sRGB"));
  spec.attribute("oiio:UnassociatedAlpha", 1);
  const bool written = output->open("memory.png", spec) &&
                       output->write_image(OIIO::TypeDesc::UINT8, image.values.data()) && output->close();
  const std::string problem = output->geterror();
  if (!written || !problem.empty()) refuse(problem);
}

}  // namespace herr
