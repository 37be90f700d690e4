// Bytes of a .vox file with a place to read at. Every read is checked against what is left, and
// every fault says at which byte of the file it lies. Before: load_vox reads the file. After:
// vox_file takes chunks from it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace herr {

class VoxBytes {
 public:
  // `bytes` and `file` must outlive the reader; `offset` is where `bytes` begin in the file.
  VoxBytes(std::string_view bytes, const std::filesystem::path& file, std::size_t offset = 0)
      : bytes_(bytes), file_(&file), offset_(offset) {}

  std::size_t left() const { return bytes_.size() - at_; }
  std::size_t offset() const { return offset_ + at_; }  // in the file
  const std::filesystem::path& file() const { return *file_; }

  // `what` names the thing that is read, for the message when the bytes run out.
  std::string_view take(std::size_t count, const char* what);
  std::uint8_t byte(const char* what) { return static_cast<std::uint8_t>(take(1, what)[0]); }
  std::int32_t int32(const char* what);  // little-endian
  // A number of things that take at least `bytes_each` bytes: no more than are left can hold.
  std::size_t count(std::size_t bytes_each, const char* what);
  std::string text(const char* what);
  // A reader of the next `count` bytes, which are passed over here.
  VoxBytes part(std::size_t count, const char* what);

  // Throws InputError "FILE: at byte N PROBLEM; REMEDY".
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

 private:
  std::string_view bytes_;
  const std::filesystem::path* file_;
  std::size_t offset_, at_ = 0;
};

}  // namespace herr
