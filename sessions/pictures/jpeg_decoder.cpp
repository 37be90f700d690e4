#include "sessions/pictures/jpeg_decoder.h"

#include <stdexcept>

#include "sessions/pictures/jpeg_failure.h"

namespace herr {
namespace {

class JpegDecoder final : public PictureDecoder {
 public:
  JpegDecoder() {
    info_.err = report_to(failure_);
    failure_.manager.emit_message = leave_where_jpeg_ends_early;
  }
  ~JpegDecoder() override { jpeg_destroy_decompress(&info_); }  // allowed before it was created
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  bool open(std::string_view bytes, PictureHeader& header, bool& ours) {
    const bool opened = open_guarded(bytes);
    if (!opened) return fail();
    const bool grey = info_.num_components == 1 && info_.jpeg_color_space == JCS_GRAYSCALE;
    const bool colour = info_.num_components == 3 &&
                        (info_.jpeg_color_space == JCS_RGB || info_.jpeg_color_space == JCS_YCbCr);
    ours = grey || colour;
    header = {static_cast<std::int32_t>(info_.image_width), static_cast<std::int32_t>(info_.image_height),
              info_.num_components, SampleType::u8};
    return true;
  }

  bool read(SampleType as, void* samples, std::size_t capacity_bytes) override {
    if (as != SampleType::u8) throw std::invalid_argument("samples of a JPEG are read as u8");
    if (capacity_bytes != row_bytes(static_cast<std::size_t>(info_.num_components)) * info_.image_height)
      throw std::invalid_argument("the room for a picture's samples is not of its size");
    return decode(static_cast<unsigned char*>(samples), info_.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB,
                  static_cast<std::size_t>(info_.num_components));
  }

#ifdef JCS_ALPHA_EXTENSIONS
  bool writes_rgba8() const override {
    return true;
  }
  bool read_rgba8(std::uint8_t* rgba) override {
    return decode(rgba, JCS_EXT_RGBA, 4);
  }
#endif

 private:
  std::size_t row_bytes(std::size_t channels) const {
    return channels * info_.image_width;
  }
  bool fail() {
    problem_ = std::string("JPEG error: ") + failure_.message;
    return false;
  }
  bool decode(unsigned char* out, J_COLOR_SPACE space, std::size_t channels) {
    return decode_guarded(out, space, row_bytes(channels)) || fail();
  }

  // Nothing with a destructor lives in these two: longjmp would pass over it.
  bool open_guarded(std::string_view bytes) {
    if (setjmp(failure_.jump) != 0) return false;
    jpeg_create_decompress(&info_);
    jpeg_mem_src(&info_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&info_, TRUE);
    return true;
  }
  bool decode_guarded(unsigned char* out, J_COLOR_SPACE space, std::size_t bytes_of_row) {
    if (setjmp(failure_.jump) != 0) return false;
    info_.out_color_space = space;
    jpeg_start_decompress(&info_);
    while (info_.output_scanline < info_.output_height) {
      unsigned char* row = out + bytes_of_row * info_.output_scanline;
      jpeg_read_scanlines(&info_, &row, 1);
    }
    jpeg_finish_decompress(&info_);
    return true;
  }

  jpeg_decompress_struct info_{};
  JpegFailure failure_;
};

}  // namespace

OpenedPicture open_jpeg(std::string_view bytes) {
  OpenedPicture opened;
  auto decoder = std::make_unique<JpegDecoder>();
  bool ours = false;
  if (!decoder->open(bytes, opened.header, ours)) {
    opened.problem = decoder->problem();
  } else if (ours) {
    opened.decoder = std::move(decoder);
  }
  return opened;
}

}  // namespace herr
