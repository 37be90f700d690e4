#include "server/output/png_encoder.h"

#include "sessions/pictures/png_writer.h"

namespace herr {

void encode_png(const Srgb8Image& image, std::vector<std::uint8_t>& out, int level) {
  out.clear();
  write_png({image.width_px, image.height_px, image.channels, image.values.data()}, level, out);
}

}  // namespace herr
