#include "sessions/pictures/jpeg_header.h"

#include "sessions/files/input_error.h"
#include "sessions/pictures/jpeg_failure.h"

namespace herr {
namespace {

// False: failure.message says why. Nothing with a destructor lives here: longjmp would pass over it.
bool parse(const unsigned char* bytes, unsigned long count, JpegHeader& header, JpegFailure& failure) {
  jpeg_decompress_struct info;
  info.err = report_to(failure);
  info.mem = nullptr;  // destroying what was never created is allowed then
  if (setjmp(failure.jump) != 0) {
    jpeg_destroy_decompress(&info);
    return false;
  }
  jpeg_create_decompress(&info);
  jpeg_mem_src(&info, bytes, count);
  jpeg_read_header(&info, TRUE);
  header.picture = {static_cast<std::int32_t>(info.image_width), static_cast<std::int32_t>(info.image_height),
                    info.num_components, SampleType::u8};
  header.cmyk = info.jpeg_color_space == JCS_CMYK || info.jpeg_color_space == JCS_YCCK;
  jpeg_destroy_decompress(&info);
  return true;
}

}  // namespace

JpegHeader read_jpeg_header(HeaderBytes& bytes) {
  // Metadata stands before the size and may be long; nearly always the first step is enough.
  constexpr std::size_t kSteps[] = {std::size_t{64} << 10, std::size_t{16} << 20};
  JpegHeader header;
  JpegFailure failure;
  for (const std::size_t step : kSteps) {
    const std::string_view first = bytes.first(step);
    if (parse(reinterpret_cast<const unsigned char*>(first.data()), first.size(), header, failure))
      return header;
    if (first.size() == bytes.size_bytes()) break;
  }
  throw InputError(bytes.path(), 0, "cannot be read as an image (" + printable(failure.message) + ")",
                   "export the image again");
}

}  // namespace herr
