// One picture in memory, decoded by the library of its format: JPEG by libjpeg, PNG by libpng, EXR and rare
// kinds of JPEG by the picture module. Before: bytes whose first ones say the format. After: camera_image,
// the textures of glTF files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "sessions/pictures/picture_decoder.h"
#include "sessions/pictures/picture_module.h"

namespace herr {

class PictureReader {
 public:
  // Reads the header; `format` is "jpeg", "png" or "openexr". The bytes must outlive the reader. Throws
  // ModuleError, std::bad_alloc, std::runtime_error for a fault of the library; what is wrong with the
  // picture stands in problem().
  PictureReader(const char* format, std::string_view bytes);

  // Why the picture could not be opened or read, as the library says it; empty while all is well.
  const std::string& problem() const { return problem_; }
  const PictureHeader& header() const { return header_; }  // of an opened picture

  // All samples; `samples` has width x height x channels of the type: u8 of any picture, u16 where they are
  // stored so, f32 of EXR. False: problem() says why. Throws as the constructor does.
  bool read(SampleType as, void* samples, std::size_t capacity_bytes);
  // All pixels as 8-bit RGBA: grey in all three colours, alpha 255 where there is none. `rgba` has 4 x width
  // x height bytes. For pictures of 1 to 4 channels. False and throws: as read().
  bool read_rgba8(std::uint8_t* rgba);

 private:
  PictureHeader header_;
  std::unique_ptr<PictureDecoder> decoder_;
  std::string problem_;
};

}  // namespace herr
