// A regular file opened for reading: a folder, a FIFO or a device is refused, and nothing blocks on opening.
// Only the bytes present at opening are read, so that a file that is still being written has one length.
// Used by everything in sessions/ that reads bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace herr {

class InputFile {
 public:
  // Throws InputError: missing, unreadable, not a regular file.
  explicit InputFile(std::filesystem::path path);
  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&& other) noexcept;
  ~InputFile();

  // Up to `capacity` next bytes; fewer only at the end of the file. Throws InputError when the disk fails.
  std::size_t read(char* bytes, std::size_t capacity);

  std::int64_t size_bytes() const { return size_bytes_; }
  const std::filesystem::path& path() const { return path_; }
  // Gives the descriptor away; the caller closes it.
  int release();

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t size_bytes_ = 0, unread_bytes_ = 0;
};

// The whole file. Throws InputError, also when it is longer than `max_bytes`.
std::string read_whole_file(const std::filesystem::path& path, std::int64_t max_bytes);

}  // namespace herr
