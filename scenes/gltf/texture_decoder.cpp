#include "scenes/gltf/texture_decoder.h"

#include <cstring>
#include <string_view>

#include "scenes/gltf/file/gltf_limits.h"
#include "sessions/files/input_error.h"
#include "sessions/pictures/header_bytes.h"
#include "sessions/pictures/jpeg_header.h"
#include "sessions/pictures/picture_reader.h"
#include "sessions/pictures/png_chunks.h"

namespace herr {
namespace {

// The reader is chosen by the file's first bytes, never by its name.
const char* format_of(const unsigned char* bytes, std::size_t size) {
  if (size >= 8 && std::memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0) return "png";
  if (size >= 3 && std::memcmp(bytes, "\xff\xd8\xff", 3) == 0) return "jpeg";
  return nullptr;
}

// Does the chain of chunks reach IEND within the bytes? The reader leaks when it runs
// off the end of its memory.
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

[[noreturn]] void fail(const EncodedImage& image, const std::string& problem, const char* remedy) {
  throw InputError(image.file, 0, "image \"" + printable(image.name) + "\" " + problem, remedy);
}

const char* known_format_of(const EncodedImage& image) {
  const char* format = format_of(image.bytes, image.size);
  if (format == nullptr) fail(image, "is neither PNG nor JPEG", "convert it to PNG");
  return format;
}

void check_texture_size(const EncodedImage& image, int width_px, int height_px, std::int64_t max_bytes) {
  const std::int64_t pixels = static_cast<std::int64_t>(width_px) * height_px;
  if (width_px < 1 || height_px < 1 || width_px > kMaxImageSide_px || height_px > kMaxImageSide_px ||
      pixels > kMaxImagePixels || 4 * pixels > max_bytes) {
    fail(image, "of " + std::to_string(width_px) + "x" + std::to_string(height_px) + " pixels is too big",
         "shrink the textures of the model");
  }
}

void check_png_end(const EncodedImage& image, const char* format) {
  if (std::strcmp(format, "png") == 0 && !png_is_whole(image.bytes, image.size))
    fail(image, "cannot be decoded (it was cut off)", "copy or export it again");
}

std::string_view bytes_of(const EncodedImage& image) {
  return {reinterpret_cast<const char*>(image.bytes), image.size};
}

}  // namespace

ImageSize texture_size(const EncodedImage& image, std::int64_t max_bytes) {
  const char* format = known_format_of(image);
  ImageSize size;
  try {
    HeaderBytes bytes(image.file, bytes_of(image));
    if (std::strcmp(format, "png") == 0) {
      size = png_size(image.file, bytes.first(kPngHeaderBytes));
    } else {
      const PictureHeader header = read_jpeg_header(bytes).picture;
      size = {header.width_px, header.height_px};
    }
  } catch (const InputError& error) {  // it knows the file, not the image within
    fail(image, "cannot be decoded (" + error.problem() + ")", "export it again");
  }
  check_texture_size(image, size.width_px, size.height_px, max_bytes);
  check_png_end(image, format);
  return size;
}

DecodedImage decode_image(const EncodedImage& from, std::int64_t max_bytes) {
  const char* format = known_format_of(from);
  PictureReader reader(format, bytes_of(from));
  if (!reader.problem().empty())
    fail(from, "cannot be decoded (" + printable(reader.problem()) + ")", "export it again");
  const PictureHeader& header = reader.header();
  check_texture_size(from, header.width_px, header.height_px, max_bytes);
  if (header.channels < 1 || header.channels > 4)
    fail(from, "has an unusual number of channels", "convert it to RGBA");
  check_png_end(from, format);
  const std::int64_t pixels = static_cast<std::int64_t>(header.width_px) * header.height_px;
  DecodedImage image{header.width_px, header.height_px, {}};
  image.rgba.resize(static_cast<std::size_t>(4 * pixels));
  if (!reader.read_rgba8(image.rgba.data()))
    fail(from, "cannot be decoded (" + printable(reader.problem()) + ")", "export it again");
  return image;
}

}  // namespace herr
