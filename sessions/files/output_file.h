// The one checked writer: a file opened for writing of which every step reports its failure as a WriteError.
// Before: bytes of an encoder or of a text. After: atomic_file (a whole file or none), append_file (rows).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "sessions/files/system/descriptor.h"
#include "sessions/files/write_error.h"

namespace herr {

// Not thread-safe. Every function throws WriteError.
class OutputFile {
 public:
  enum class Opening {
    make,             // one of that name must not exist
    make_for_append,  // the same, and every write goes to the end
    append,           // made where it is missing
  };
  // `shown` is the name that messages tell: the final one, where `path` is a temporary one.
  OutputFile(const std::filesystem::path& path, std::filesystem::path shown, Opening opening);
  OutputFile(OutputFile&&) noexcept = default;
  OutputFile& operator=(OutputFile&&) = delete;
  // Closes the file; a failure of that stays unknown: call close().
  ~OutputFile() = default;

  // All of it. After a failure `written` bytes of it are in the file.
  void write(std::string_view bytes, std::size_t& written);
  void write(std::string_view bytes);
  void cut(std::int64_t kept_bytes);
  // Cuts the last bytes off, if the disk lets us; a failure is of no consequence.
  void take_back(std::size_t bytes) noexcept;
  // Waits until the disk has the bytes.
  void sync();
  void close();

 private:
  std::filesystem::path shown_;
  Descriptor descriptor_;
};

}  // namespace herr
