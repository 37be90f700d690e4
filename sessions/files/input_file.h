// A regular file opened for reading: a folder, a FIFO or a device is refused, and nothing blocks on opening.
// Only the bytes present at opening are read, so that a file that is still being written has one length.
// Used by everything that reads bytes. Before: descriptor, contained_folder. After: line_reader, strict_json,
// the readers of pictures and models.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "sessions/files/system/descriptor.h"

namespace herr {

// Not thread-safe.
class InputFile {
 public:
  // Throws InputError: missing, unreadable, not a regular file; std::system_error where the machine is short
  // of descriptors or memory, which is no fault of the file.
  explicit InputFile(std::filesystem::path path);
  // The same for a file that was opened elsewhere; `path` is its name for messages.
  InputFile(std::filesystem::path path, OpenedFile opened);

  // Up to `capacity` next bytes; fewer only at the end of the file. Throws InputError when the disk fails.
  std::size_t read(char* bytes, std::size_t capacity);
  // The same from any place on, apart from what read() comes to next.
  std::size_t read_at(std::int64_t offset, char* bytes, std::size_t capacity) const;

  std::int64_t size_bytes() const { return size_bytes_; }
  unsigned mode() const { return mode_; }  // permission bits
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  Descriptor descriptor_;
  unsigned mode_ = 0;
  std::int64_t size_bytes_ = 0, offset_ = 0;
};

// What the machine lacks for the moment (descriptors, memory): trying again may help, another file will not.
bool is_shortage(int error_number);
// Throws std::system_error "PATH: WHAT: reason" for a shortage; returns for anything else.
void throw_shortage(int error_number, const std::filesystem::path& path, const std::string& what);

// How much of a file is accepted, and what to do about one that is longer.
struct SizeLimit {
  std::int64_t max_bytes = 0;
  const char* remedy = "check that this is the right file";
};

// All of an open file from its start. `Bytes`: std::string, std::vector<unsigned char>. Throws InputError,
// also when it is longer than the limit or becomes shorter while it is read.
template <class Bytes>
Bytes all_bytes(const InputFile& file, const SizeLimit& limit);

// The whole file. Throws as InputFile and all_bytes.
std::string read_whole_file(const std::filesystem::path& path, const SizeLimit& limit);
std::string read_whole_file(const std::filesystem::path& path, std::int64_t max_bytes);

// A text that the kernel makes up as it is read, without a size (/proc, /sys); empty where it is not there.
std::string read_kernel_text(const char* path);

}  // namespace herr
