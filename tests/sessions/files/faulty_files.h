// A file system that fails as disks do: any one call of a kind, or all from the n-th on; transfers that take
// only a part; calls that a signal interrupts. It stands before the real one while it lives. The idea is
// LevelDB's (db/fault_injection_test.cc): count the calls of an action, then let each of them fail in turn.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "sessions/files/system/file_system.h"

namespace herr::test {

enum class FileCall { open, read, write, truncate, sync, close, rename, remove, make_folder, list, lock };
inline constexpr std::size_t kFileCalls = 11;
const char* name_of(FileCall call);

// Thread-safe.
class FaultyFiles : public FileSystem {
 public:
  FaultyFiles();
  ~FaultyFiles() override;

  // The n-th call of that kind from now on, counted from 0, and all later ones fail with `error`. A write
  // that fails takes the first half of its bytes before, as a disk does that fills up.
  void fail_from(FileCall call, int n, int error);
  // Reads and writes take at most so many bytes at once.
  void transfer_at_most(std::size_t bytes);
  // Every second call is interrupted.
  void interrupt();
  // The kernel has no openat2.
  void forget_open_beneath();

  bool has_failed() const;
  int calls(FileCall call) const;
  // Names under which a file appeared while some of its bytes were not synced: a power
  // cut could leave half of it.
  std::vector<std::string> renamed_before_sync() const;

  int open(const char* path, int flags) override;
  int open_beneath(int folder, const char* name, int flags) override;
  ssize_t read_at(int descriptor, void* bytes, std::size_t count, off_t offset) override;
  ssize_t write(int descriptor, const void* bytes, std::size_t count) override;
  int truncate(int descriptor, off_t bytes) override;
  int sync(int descriptor) override;
  int lock(int descriptor) override;
  int close(int descriptor) override;
  int list(const char* folder, std::vector<std::string>& names) override;
  int rename(const char* from, const char* to) override;
  int remove(const char* path) override;
  int make_folder(const char* path) override;

 private:
  // The errno of the fault that this call has to show, or 0.
  int fault(FileCall call);

  mutable std::mutex mutex_;
  FileCall failing_ = FileCall::open;
  int fail_from_ = -1, error_ = 0;
  bool failed_ = false, interrupts_ = false, interrupt_next_ = false, has_open_beneath_ = true;
  std::size_t most_bytes_ = static_cast<std::size_t>(-1);
  std::array<int, kFileCalls> calls_{};
  std::map<int, std::string> open_paths_;
  std::set<std::string> unsynced_;
  std::vector<std::string> renamed_before_sync_;
};

}  // namespace herr::test
