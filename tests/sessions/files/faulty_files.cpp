#include "tests/sessions/files/faulty_files.h"

#include <algorithm>
#include <cerrno>
#include <utility>

namespace herr::test {

const char* name_of(FileCall call) {
  static constexpr std::array<const char*, kFileCalls> kNames{"open",        "read",  "write",  "truncate",
                                                              "sync",        "close", "rename", "remove",
                                                              "make_folder", "list",  "lock"};
  return kNames[static_cast<std::size_t>(call)];
}

FaultyFiles::FaultyFiles() {
  use_file_system(this);
}

FaultyFiles::~FaultyFiles() {
  use_file_system(nullptr);
}

void FaultyFiles::fail_from(FileCall call, int n, int error) {
  const std::lock_guard lock(mutex_);
  failing_ = call;
  fail_from_ = n;
  error_ = error;
  failed_ = false;
  calls_ = {};
}

void FaultyFiles::transfer_at_most(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  most_bytes_ = bytes;
}

void FaultyFiles::interrupt() {
  const std::lock_guard lock(mutex_);
  interrupts_ = true;
}

void FaultyFiles::forget_open_beneath() {
  const std::lock_guard lock(mutex_);
  has_open_beneath_ = false;
}

bool FaultyFiles::has_failed() const {
  const std::lock_guard lock(mutex_);
  return failed_;
}

int FaultyFiles::calls(FileCall call) const {
  const std::lock_guard lock(mutex_);
  return calls_[static_cast<std::size_t>(call)];
}

std::vector<std::string> FaultyFiles::renamed_before_sync() const {
  const std::lock_guard lock(mutex_);
  return renamed_before_sync_;
}

int FaultyFiles::fault(FileCall call) {
  const std::lock_guard lock(mutex_);
  // Neither lists nor renames are ever interrupted, and an interrupted close() has closed.
  const bool can_interrupt = call <= FileCall::sync;
  if (interrupts_ && can_interrupt && std::exchange(interrupt_next_, !interrupt_next_)) return EINTR;
  const int count = calls_[static_cast<std::size_t>(call)]++;
  if (call != failing_ || fail_from_ < 0 || count < fail_from_) return 0;
  failed_ = true;
  return error_;
}

int FaultyFiles::open(const char* path, int flags) {
  if (const int error = fault(FileCall::open); error != 0) return -error;
  const int descriptor = FileSystem::open(path, flags);
  const std::lock_guard lock(mutex_);
  if (descriptor >= 0) open_paths_[descriptor] = path;
  return descriptor;
}

int FaultyFiles::open_beneath(int folder, const char* name, int flags) {
  if (!has_open_beneath_) return -ENOSYS;
  if (const int error = fault(FileCall::open); error != 0) return -error;
  return FileSystem::open_beneath(folder, name, flags);
}

ssize_t FaultyFiles::read_at(int descriptor, void* bytes, std::size_t count, off_t offset) {
  if (const int error = fault(FileCall::read); error != 0) return -error;
  return FileSystem::read_at(descriptor, bytes, std::min(count, most_bytes_), offset);
}

ssize_t FaultyFiles::write(int descriptor, const void* bytes, std::size_t count) {
  const bool had_failed = has_failed();
  const int error = fault(FileCall::write);
  if (error != 0 && (error == EINTR || had_failed || count < 2)) return -error;
  {
    const std::lock_guard lock(mutex_);
    if (const auto path = open_paths_.find(descriptor); path != open_paths_.end())
      unsynced_.insert(path->second);
  }
  return FileSystem::write(descriptor, bytes, std::min(error != 0 ? count / 2 : count, most_bytes_));
}

int FaultyFiles::truncate(int descriptor, off_t bytes) {
  if (const int error = fault(FileCall::truncate); error != 0) return -error;
  return FileSystem::truncate(descriptor, bytes);
}

int FaultyFiles::sync(int descriptor) {
  if (const int error = fault(FileCall::sync); error != 0) return -error;
  const std::lock_guard lock(mutex_);
  if (const auto path = open_paths_.find(descriptor); path != open_paths_.end())
    unsynced_.erase(path->second);
  return 0;  // nobody pulls the plug of a test
}

int FaultyFiles::lock(int descriptor) {
  if (const int error = fault(FileCall::lock); error != 0) return -error;
  return FileSystem::lock(descriptor);
}

int FaultyFiles::close(int descriptor) {
  const int error = fault(FileCall::close);
  {
    const std::lock_guard lock(mutex_);
    open_paths_.erase(descriptor);
  }
  const int result = FileSystem::close(descriptor);  // a descriptor is gone even when close() fails
  return error != 0 ? -error : result;
}

int FaultyFiles::list(const char* folder, std::vector<std::string>& names) {
  if (const int error = fault(FileCall::list); error != 0) return -error;
  return FileSystem::list(folder, names);
}

int FaultyFiles::rename(const char* from, const char* to) {
  if (const int error = fault(FileCall::rename); error != 0) return -error;
  {
    const std::lock_guard lock(mutex_);
    if (unsynced_.erase(from) > 0) renamed_before_sync_.emplace_back(to);
  }
  return FileSystem::rename(from, to);
}

int FaultyFiles::remove(const char* path) {
  if (const int error = fault(FileCall::remove); error != 0) return -error;
  return FileSystem::remove(path);
}

int FaultyFiles::make_folder(const char* path) {
  if (const int error = fault(FileCall::make_folder); error != 0) return -error;
  return FileSystem::make_folder(path);
}

}  // namespace herr::test
