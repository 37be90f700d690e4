#include "server/output/png_encoder.h"

#include <new>
#include <stdexcept>
#include <string>

#include "sessions/pictures/loaded_module.h"
#include "sessions/pictures/picture_reader.h"

namespace herr {
namespace {

// The module's way to hand over bytes: nothing may be thrown through it.
bool append(void* user, const void* bytes, std::size_t count) noexcept try {
  auto& out = *static_cast<std::vector<std::uint8_t>*>(user);
  const auto* begin = static_cast<const std::uint8_t*>(bytes);
  out.insert(out.end(), begin, begin + count);
  return true;
} catch (const std::exception&) {
  return false;
}

}  // namespace

void encode_png(const Srgb8Image& image, std::vector<std::uint8_t>& out, int level) {
  out.clear();
  PictureProblem problem;
  const PngRequest request{image.width_px, image.height_px, image.channels, level, image.values.data(),
                           &out,           append};
  if (picture_module().encode_png(&request, &problem)) return;
  throw_unless_bad_picture(problem);
  throw std::runtime_error("PNG encoder: " + std::string(problem.text));
}

}  // namespace herr
