// The one seam between the program and its files: what herr reads, writes, lists, renames, locks or removes
// passes through here. Above it stand the other files of this folder, which alone know of short transfers,
// interruptions and error numbers; below it is the kernel. Tests put another FileSystem before the real one
// and let single calls fail (the idea of LevelDB's Env, include/leveldb/env.h, db/fault_injection_test.cc).
#pragma once

#include <sys/stat.h>
#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace herr {

// Each function is one POSIX call and returns its result, or minus its errno. Thread-safe. A test derives
// from this class, overrides what shall fail, and calls the function of this class for what shall not.
class FileSystem {
 public:
  virtual ~FileSystem() = default;

  // A new descriptor, never inherited by child processes; files that are made get mode 0666 less the umask.
  virtual int open(const char* path, int flags);
  // The same by openat2(RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS): -EXDEV where `name`
  // leads out of the folder.
  virtual int open_beneath(int folder, const char* name, int flags);
  virtual ssize_t read_at(int descriptor, void* bytes, std::size_t count, off_t offset);  // pread
  virtual ssize_t write(int descriptor, const void* bytes, std::size_t count);
  virtual int truncate(int descriptor, off_t bytes);
  virtual int sync(int descriptor);
  virtual int lock(int descriptor);  // flock(LOCK_EX | LOCK_NB): -EWOULDBLOCK where another process has it
  virtual int close(int descriptor);

  virtual int status(int descriptor, struct stat& status);
  virtual int status(const char* path, bool follow_links, struct stat& status);
  virtual int access(const char* path, int mode);
  virtual int real_path(const char* path, std::string& resolved);         // every link of it resolved
  virtual int list(const char* folder, std::vector<std::string>& names);  // without "." and ".."

  virtual int rename(const char* from, const char* to);
  virtual int remove(const char* path);       // a file, a link or an empty folder
  virtual int make_folder(const char* path);  // mode 0777 less the umask
};

// The one in use: the kernel's, or what a test put before it. Never null; any thread may ask.
FileSystem& file_system();

// Puts `instead` in place of the kernel's; null: back to the kernel. For tests, while no other thread is at
// work on files: descriptors pass from one to the next, so that files may be open meanwhile.
void use_file_system(FileSystem* instead);

}  // namespace herr
