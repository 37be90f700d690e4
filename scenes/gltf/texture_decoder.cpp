#include "scenes/gltf/texture_decoder.h"

#include <cstring>
#include <string_view>

#include "scenes/gltf/file/gltf_limits.h"
#include "sessions/files/input_error.h"
#include "sessions/pictures/picture_reader.h"

namespace herr {
namespace {

// The reader is chosen by the file's first bytes, never by its name.
const char* format_of(const unsigned char* bytes, std::size_t size) {
  if (size >= 8 && std::memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0) return "png";
  if (size >= 3 && std::memcmp(bytes, "\xff\xd8\xff", 3) == 0) return "jpeg";
  return nullptr;
}

// Does the chain of chunks reach IEND within the bytes? The reader leaks when it runs off the end of its
// memory.
bool png_is_whole(const unsigned char* bytes, std::size_t size) {
  std::size_t at = 8;  // past the signature; a chunk is length, name, data, CRC
  while (size - at >= 12) {
    const std::size_t length = (std::size_t{bytes[at]} << 24) | (std::size_t{bytes[at + 1]} << 16) |
                               (std::size_t{bytes[at + 2]} << 8) | std::size_t{bytes[at + 3]};
    if (length > size - at - 12) return false;
    if (std::memcmp(bytes + at + 4, "IEND", 4) == 0) return true;
    at += length + 12;
  }
  return false;
}

// Grey, grey + alpha, RGB or RGBA rows to RGBA, in place from the end.
void expand_to_rgba(std::vector<std::uint8_t>& rgba, std::size_t pixels, int channels) {
  const auto width = static_cast<std::size_t>(channels);
  for (std::size_t i = pixels; i-- > 0;) {
    std::uint8_t from[4] = {0, 0, 0, 255};
    std::memcpy(from, &rgba[i * width], width);
    const bool grey = channels <= 2;
    const std::uint8_t alpha = channels == 2 ? from[1] : from[3];
    rgba[4 * i + 0] = from[0];
    rgba[4 * i + 1] = grey ? from[0] : from[1];
    rgba[4 * i + 2] = grey ? from[0] : from[2];
    rgba[4 * i + 3] = alpha;
  }
}

}  // namespace

DecodedImage decode_image(const unsigned char* bytes, std::size_t size, std::int64_t max_bytes,
                          const std::filesystem::path& file, const std::string& name) {
  const auto fail = [&](const std::string& problem, const char* remedy) {
    return InputError(file, 0, "image \"" + printable(name) + "\" " + problem, remedy);
  };
  const char* format = format_of(bytes, size);
  if (format == nullptr) throw fail("is neither PNG nor JPEG", "convert it to PNG");

  PictureReader reader(format, {reinterpret_cast<const char*>(bytes), size});
  if (!reader.problem().empty())
    throw fail("cannot be decoded (" + printable(reader.problem()) + ")", "export it again");
  const PictureHeader& header = reader.header();
  const std::int64_t pixels = static_cast<std::int64_t>(header.width_px) * header.height_px;
  const std::string dimensions = std::to_string(header.width_px) + "x" + std::to_string(header.height_px);
  if (header.width_px < 1 || header.height_px < 1 || header.width_px > kMaxImageSide_px ||
      header.height_px > kMaxImageSide_px || pixels > kMaxImagePixels || 4 * pixels > max_bytes) {
    throw fail("of " + dimensions + " pixels is too big", "shrink the textures of the model");
  }
  if (header.channels < 1 || header.channels > 4)
    throw fail("has an unusual number of channels", "convert it to RGBA");

  if (std::strcmp(format, "png") == 0 && !png_is_whole(bytes, size)) {
    throw fail("cannot be decoded (it was cut off)", "copy or export it again");
  }
  DecodedImage image{header.width_px, header.height_px, {}};
  image.rgba.resize(static_cast<std::size_t>(4 * pixels));
  if (!reader.read(SampleType::u8, image.rgba.data(), static_cast<std::size_t>(pixels * header.channels)))
    throw fail("cannot be decoded (" + printable(reader.problem()) + ")", "export it again");
  expand_to_rgba(image.rgba, static_cast<std::size_t>(pixels), header.channels);
  return image;
}

}  // namespace herr
