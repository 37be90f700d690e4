// An open file that closes itself, and the transfers that finish what they begin: a call that was interrupted
// is made again, a write that took a part goes on with the rest. Before: file_system. After: input_file,
// output_file, contained_folder, folder_lock.
#pragma once

#include <fcntl.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace herr {

// Not thread-safe.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();

  int get() const { return descriptor_; }
  bool is_open() const { return descriptor_ >= 0; }
  // 0 or the errno; closed either way. Nothing happens to one that is closed.
  int close() noexcept;

 private:
  int descriptor_ = -1;
};

// A descriptor, or the errno of why there is none.
struct OpenedFile {
  Descriptor descriptor;
  int error = 0;
};

OpenedFile open_file(const std::filesystem::path& path, int flags);
// Opening does not wait: not for the writer of a pipe, not for a terminal.
inline constexpr int kReadFlags = O_RDONLY | O_NONBLOCK | O_NOCTTY;
OpenedFile open_for_reading(const std::filesystem::path& path);

// Each returns 0 or the errno of the failure.
// `written`, where given, tells how many bytes were taken all the same.
int write_all(int descriptor, const void* bytes, std::size_t count, std::size_t* written = nullptr);
int cut_to(int descriptor, std::int64_t bytes);
// Waits until the disk has the bytes. What cannot be synced (pipes, some network folders) loses nothing: 0.
// Not to be tried again after a failure: the kernel may have dropped the pages that it could not write.
int sync_to_disk(int descriptor);

// Bytes read from `offset` on, fewer than `count` only at the end of the file; or minus the errno.
std::int64_t read_all(int descriptor, void* bytes, std::size_t count, std::int64_t offset);

}  // namespace herr
