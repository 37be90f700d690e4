#include "sessions/files/system/file_system.h"

#include <dirent.h>
#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace herr {
namespace {

constexpr mode_t kFileMode = 0666, kFolderMode = 0777;

template <class Result>
Result or_error(Result result) {
  return result < 0 ? -static_cast<Result>(errno) : result;
}

std::atomic<FileSystem*> in_use{nullptr};

}  // namespace

int FileSystem::open(const char* path, int flags) {
  return or_error(::open(path, flags | O_CLOEXEC, kFileMode));
}

int FileSystem::open_beneath(int folder, const char* name, int flags) {
  struct open_how how {};
  how.flags = static_cast<std::uint64_t>(flags | O_CLOEXEC);
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  return static_cast<int>(or_error(::syscall(SYS_openat2, folder, name, &how, sizeof(how))));
}

ssize_t FileSystem::read_at(int descriptor, void* bytes, std::size_t count, off_t offset) {
  return or_error(::pread(descriptor, bytes, count, offset));
}

ssize_t FileSystem::write(int descriptor, const void* bytes, std::size_t count) {
  return or_error(::write(descriptor, bytes, count));
}

int FileSystem::truncate(int descriptor, off_t bytes) {
  return or_error(::ftruncate(descriptor, bytes));
}

int FileSystem::sync(int descriptor) {
  return or_error(::fsync(descriptor));
}

int FileSystem::lock(int descriptor) {
  return or_error(::flock(descriptor, LOCK_EX | LOCK_NB));
}

int FileSystem::close(int descriptor) {
  return or_error(::close(descriptor));
}

int FileSystem::status(int descriptor, struct stat& status) {
  return or_error(::fstat(descriptor, &status));
}

int FileSystem::status(const char* path, bool follow_links, struct stat& status) {
  return or_error(follow_links ? ::stat(path, &status) : ::lstat(path, &status));
}

int FileSystem::access(const char* path, int mode) {
  return or_error(::access(path, mode));
}

int FileSystem::real_path(const char* path, std::string& resolved) {
  char* found = ::realpath(path, nullptr);
  if (found == nullptr) return -errno;
  resolved = found;
  std::free(found);
  return 0;
}

int FileSystem::list(const char* folder, std::vector<std::string>& names) {
  DIR* opened = ::opendir(folder);
  if (opened == nullptr) return -errno;
  errno = 0;
  while (const dirent* entry = ::readdir(opened)) {
    const std::string_view name = entry->d_name;
    if (name != "." && name != "..") names.emplace_back(name);
  }
  const int error = errno;  // readdir() sets it at a failure, and leaves it alone at the end
  ::closedir(opened);
  return -error;
}

int FileSystem::rename(const char* from, const char* to) {
  return or_error(::rename(from, to));
}

int FileSystem::remove(const char* path) {
  return or_error(::remove(path));
}

int FileSystem::make_folder(const char* path) {
  return or_error(::mkdir(path, kFolderMode));
}

FileSystem& file_system() {
  static FileSystem kernel;
  FileSystem* const instead = in_use.load(std::memory_order_acquire);
  return instead != nullptr ? *instead : kernel;
}

void use_file_system(FileSystem* instead) {
  in_use.store(instead, std::memory_order_release);
}

}  // namespace herr
