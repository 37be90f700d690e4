#include "sessions/pictures/jpeg_header.h"

#include <csetjmp>
#include <cstdio>

// After <cstdio>, which it needs and does not include.
#include <jpeglib.h>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

// libjpeg's way to report: it calls error_exit, which must not return.
struct Failure {
  jpeg_error_mgr manager{};  // first: libjpeg hands back a pointer to it
  std::jmp_buf jump{};
  char message[JMSG_LENGTH_MAX] = "";
};

[[noreturn]] void leave(j_common_ptr info) {
  auto* failure = reinterpret_cast<Failure*>(info->err);
  info->err->format_message(info, failure->message);
  std::longjmp(failure->jump, 1);
}

void ignore_warning(j_common_ptr) {}

// False: failure.message says why. Nothing with a destructor lives here: longjmp would pass over it.
bool parse(const unsigned char* bytes, unsigned long count, JpegHeader& header, Failure& failure) {
  jpeg_decompress_struct info;
  info.err = jpeg_std_error(&failure.manager);
  failure.manager.error_exit = leave;
  failure.manager.output_message = ignore_warning;  // warnings: decoding judges them
  info.mem = nullptr;                               // destroying what was never created is allowed then
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
  Failure failure;
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
