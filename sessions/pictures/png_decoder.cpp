#include "sessions/pictures/png_decoder.h"

#include <png.h>

#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

namespace herr {
namespace {

void ignore_png_warning(png_structp, png_const_charp) {}

class PngDecoder final : public PictureDecoder {
 public:
  PngDecoder() : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, leave, ignore_png_warning)) {
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ != nullptr) return;
    png_destroy_read_struct(&png_, nullptr, nullptr);
    throw std::bad_alloc();
  }
  ~PngDecoder() override { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;

  bool open(std::string_view bytes, PictureHeader& header) {
    left_ = bytes;
    if (!open_guarded()) return fail();
    header = {static_cast<std::int32_t>(png_get_image_width(png_, info_)),
              static_cast<std::int32_t>(png_get_image_height(png_, info_)), png_get_channels(png_, info_),
              wide() ? SampleType::u16 : SampleType::u8};
    return true;
  }

  bool read(SampleType as, void* samples, std::size_t capacity_bytes) override {
    if (as != SampleType::u8 && as != SampleType::u16)
      throw std::invalid_argument("samples of a PNG are read as u8 or u16");
    const std::size_t width = png_get_rowbytes(png_, info_) / (wide() ? 2 : 1), height = this->height();
    if (capacity_bytes != width * height * (as == SampleType::u16 ? 2 : 1))
      throw std::invalid_argument("the room for a picture's samples is not of its size");
    if (wide() == (as == SampleType::u16)) return decode(static_cast<png_bytep>(samples));
    std::vector<png_byte> stored(png_get_rowbytes(png_, info_) * height);
    if (!decode(stored.data())) return false;
    convert(stored, width * height, as, samples);
    return true;
  }

  bool writes_rgba8() const override { return !wide() && png_get_channels(png_, info_) == 4; }
  bool read_rgba8(std::uint8_t* rgba) override { return decode(rgba); }

 private:
  bool wide() const { return png_get_bit_depth(png_, info_) == 16; }
  std::size_t height() const { return png_get_image_height(png_, info_); }
  bool fail() {
    problem_ = std::string("PNG error: ") + message_;
    return false;
  }

  // 16 bits to 8 and back, each to the nearest: 65535 = 257 * 255.
  static void convert(const std::vector<png_byte>& stored, std::size_t count, SampleType as, void* samples) {
    for (std::size_t i = 0; i < count; ++i) {
      if (as == SampleType::u16) {
        static_cast<std::uint16_t*>(samples)[i] = static_cast<std::uint16_t>(257 * stored[i]);
        continue;
      }
      std::uint16_t value;
      std::memcpy(&value, &stored[2 * i], sizeof value);
      static_cast<std::uint8_t*>(samples)[i] = static_cast<std::uint8_t>((value + 128) / 257);
    }
  }

  bool decode(png_bytep out) {
    std::vector<png_bytep> rows(height());
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = out + y * png_get_rowbytes(png_, info_);
    return decode_guarded(rows.data()) || fail();
  }

  // Libpng's way to report: this must not return.
  [[noreturn]] static void leave(png_structp png, png_const_charp text) {
    auto* self = static_cast<PngDecoder*>(png_get_error_ptr(png));
    std::strncpy(self->message_, text, sizeof self->message_ - 1);
    png_longjmp(png, 1);
  }
  static void take(png_structp png, png_bytep out, std::size_t count) {
    auto* self = static_cast<PngDecoder*>(png_get_io_ptr(png));
    if (count > self->left_.size()) png_error(png, "the data end early");
    std::memcpy(out, self->left_.data(), count);
    self->left_.remove_prefix(count);
  }

  // Nothing with a destructor lives in these two: longjmp would pass over it.
  bool open_guarded() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, this, take);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);  // all that need not be read
    png_read_info(png_, info_);
    png_set_expand(png_);
    png_set_swap(png_);  // 16 bits in our order
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }
  bool decode_guarded(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

  char message_[128] = "";
  std::string_view left_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

OpenedPicture open_png(std::string_view bytes) {
  OpenedPicture opened;
  auto decoder = std::make_unique<PngDecoder>();
  if (decoder->open(bytes, opened.header)) {
    opened.decoder = std::move(decoder);
  } else {
    opened.problem = decoder->problem();
  }
  return opened;
}

}  // namespace herr
