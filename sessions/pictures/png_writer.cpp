#include "sessions/pictures/png_writer.h"

#include <png.h>

#include <cstddef>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>

namespace herr {
namespace {

// One file being written; nothing is thrown through libpng.
struct PngWriting {
  std::vector<std::uint8_t>* out = nullptr;
  bool full = false;
  char message[128] = "";
};

[[noreturn]] void leave_writing(png_structp png, png_const_charp text) {
  auto* writing = static_cast<PngWriting*>(png_get_error_ptr(png));
  std::strncpy(writing->message, text, sizeof writing->message - 1);
  png_longjmp(png, 1);
}

void no_warning(png_structp, png_const_charp) {}

bool append_png(PngWriting& writing, const png_byte* bytes, std::size_t count) noexcept try {
  writing.out->insert(writing.out->end(), bytes, bytes + count);
  return true;
} catch (const std::exception&) {
  writing.full = true;
  return false;
}

void give(png_structp png, png_bytep bytes, std::size_t count) {
  if (!append_png(*static_cast<PngWriting*>(png_get_io_ptr(png)), bytes, count))
    png_error(png, "no memory for it");
}

void nothing_to_flush(png_structp) {}

// Nothing with a destructor lives here: longjmp would pass over it.
bool write_guarded(png_structp png, png_infop info, const PngPixels& pixels, int level, PngWriting& writing) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_write_fn(png, &writing, give, nothing_to_flush);
  png_set_compression_level(png, level);
  png_set_IHDR(png, info, static_cast<png_uint_32>(pixels.width_px),
               static_cast<png_uint_32>(pixels.height_px), 8,
               pixels.channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
  png_write_info(png, info);
  const std::size_t row_bytes =
      static_cast<std::size_t>(pixels.width_px) * static_cast<std::size_t>(pixels.channels);
  for (int y = 0; y < pixels.height_px; ++y)
    png_write_row(png, pixels.values + static_cast<std::size_t>(y) * row_bytes);
  png_write_end(png, nullptr);
  return true;
}

}  // namespace

void write_png(const PngPixels& pixels, int level, std::vector<std::uint8_t>& out) {
  if (pixels.channels != 3 && pixels.channels != 4) throw std::invalid_argument("a PNG has 3 or 4 channels");
  PngWriting writing{&out};
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writing, leave_writing, no_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  const bool written = info != nullptr && write_guarded(png, info, pixels, level, writing);
  png_destroy_write_struct(&png, &info);
  if (written) return;
  if (writing.full || info == nullptr) throw std::bad_alloc();
  throw std::runtime_error("PNG encoder: " + std::string(writing.message));
}

}  // namespace herr
