// The first bytes of a picture, as far as its header reaches: from a file, which is read no further than
// somebody asks, or from memory. Before: InputFile. After: recognised_format, jpeg_header, exr_header.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sessions/files/input_file.h"

namespace herr {

class HeaderBytes {
 public:
  // The file must outlive this and be at its beginning.
  explicit HeaderBytes(InputFile& file);
  // `whole` must outlive this; `path` is what errors name.
  HeaderBytes(std::filesystem::path path, std::string_view whole);

  // The first `count` bytes, fewer only where there are no more. Ends the life of earlier results.
  // Throws InputError when the disk fails.
  std::string_view first(std::size_t count);

  std::size_t size_bytes() const { return size_bytes_; }  // of the whole picture
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  InputFile* file_ = nullptr;
  std::string read_;        // of the file so far
  std::string_view whole_;  // in memory
  std::size_t size_bytes_ = 0;
};

}  // namespace herr
