// One opened picture, whichever library decodes it. Before: bytes whose first ones say the format. After:
// picture_reader, which chooses the library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "sessions/pictures/picture_module.h"

namespace herr {

// False results: problem() says why.
class PictureDecoder {
 public:
  virtual ~PictureDecoder() = default;
  // All samples; the room is one that picture_reader.h allows.
  virtual bool read(SampleType as, void* samples, std::size_t capacity_bytes) = 0;
  // All pixels as 8-bit RGBA, where the library writes that by itself: no pass over the picture to widen it.
  virtual bool writes_rgba8() const { return false; }
  virtual bool read_rgba8(std::uint8_t*) { return false; }
  const std::string& problem() const { return problem_; }

 protected:
  std::string problem_;
};

// What opening comes to: a decoder, or the reason why there is none, or neither: the picture is of a kind
// that another library is left to.
struct OpenedPicture {
  std::unique_ptr<PictureDecoder> decoder;
  PictureHeader header;
  std::string problem;
};

}  // namespace herr
