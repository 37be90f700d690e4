// One picture in memory, decoded by the picture module. Before: bytes whose first ones say the format.
// After: camera_image, the textures of glTF files, pictures of environments.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "sessions/pictures/picture_module.h"

namespace herr {

class PictureReader {
 public:
  // Reads the header; `format` is one of those of PictureModule::open. The bytes must outlive the reader.
  // Throws ModuleError, std::bad_alloc, std::runtime_error for a fault of the library; what is wrong with the
  // picture stands in problem().
  PictureReader(const char* format, std::string_view bytes);

  // Why the picture could not be opened or read, as the library says it; empty while all is well.
  const std::string& problem() const { return problem_; }
  const PictureHeader& header() const { return header_; }  // of an opened picture

  // All samples; `samples` has width x height x channels of the type. False: problem() says why.
  // Throws as the constructor does.
  bool read(SampleType as, void* samples, std::size_t capacity_bytes);

 private:
  const PictureModule& module_;
  PictureHeader header_;
  std::unique_ptr<OpenPicture, void (*)(OpenPicture*) noexcept> picture_;
  std::string problem_;
};

// Throws what is no fault of the picture: std::bad_alloc, or std::runtime_error with the library's text.
void throw_unless_bad_picture(const PictureProblem& problem);

}  // namespace herr
