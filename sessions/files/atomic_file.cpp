#include "sessions/files/atomic_file.h"

#include <unistd.h>

#include <charconv>
#include <system_error>
#include <utility>

#include "sessions/files/system/file_system.h"

namespace herr {
namespace {

std::filesystem::path temporary_name_for(const std::filesystem::path& final_name) {
  std::filesystem::path name = final_name;
  name += ".tmp." + std::to_string(::getpid());
  return name;
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path final_name)
    : final_name_(std::move(final_name)),
      temporary_name_(temporary_name_for(final_name_)),
      file_(temporary_name_, final_name_, OutputFile::Opening::make) {}

AtomicFile::~AtomicFile() {
  // Only where a step failed (and threw) or the file was given up: no further error to report.
  if (!committed_) file_system().remove(temporary_name_.c_str());
}

void AtomicFile::write(std::span<const std::uint8_t> bytes) {
  file_.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void AtomicFile::write(std::string_view text) {
  file_.write(text);
}

void AtomicFile::commit() {
  file_.sync();
  file_.close();
  const int result = file_system().rename(temporary_name_.c_str(), final_name_.c_str());
  if (result < 0) throw WriteError(final_name_, "rename", -result);
  committed_ = true;
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
