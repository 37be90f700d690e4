#include "sessions/files/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <system_error>
#include <utility>

namespace herr {
AtomicFile::AtomicFile(std::filesystem::path final_name) : final_name_(std::move(final_name)) {
  temporary_name_ = final_name_;
  temporary_name_ += ".tmp." + std::to_string(::getpid());
  fd_ = ::open(temporary_name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd_ < 0) throw WriteError(final_name_, "create", errno);
  exists_ = true;
}

AtomicFile::~AtomicFile() {
  remove_temporary();
}

void AtomicFile::remove_temporary() noexcept {
  // Only reached when the write already failed (and threw) or was given up: no further error to report.
  if (fd_ >= 0) ::close(std::exchange(fd_, -1));
  if (std::exchange(exists_, false)) ::unlink(temporary_name_.c_str());
}

void AtomicFile::write(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd_, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      throw WriteError(final_name_, "write", errno);
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void AtomicFile::write(std::string_view text) {
  write(std::span<const std::uint8_t>(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void AtomicFile::commit() {
  sync_file(fd_, final_name_);
  if (::close(std::exchange(fd_, -1)) != 0) throw WriteError(final_name_, "close", errno);
  if (::rename(temporary_name_.c_str(), final_name_.c_str()) != 0) {
    throw WriteError(final_name_, "rename", errno);
  }
  exists_ = false;
}

void write_whole_file(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  AtomicFile output(file);
  output.write(bytes);
  output.commit();
}

void write_whole_file(const std::filesystem::path& file, std::string_view text) {
  AtomicFile output(file);
  output.write(text);
  output.commit();
}

long temporary_file_pid(const std::string& file_name) {
  const std::size_t mark = file_name.rfind(".tmp.");
  if (mark == std::string::npos || mark == 0) return 0;
  const char* begin = file_name.data() + mark + 5;
  const char* end = file_name.data() + file_name.size();
  long pid = 0;
  const auto [stop, error] = std::from_chars(begin, end, pid);
  return error == std::errc() && stop == end && pid > 0 ? pid : 0;
}

}  // namespace herr
