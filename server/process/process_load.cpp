#include "server/process/process_load.h"

#include <sstream>
#include <string>

#include "renderer/threads/cpu_use.h"
#include "sessions/files/input_file.h"

namespace herr {
namespace {

std::optional<std::int64_t> most_resident_bytes() {
  std::istringstream lines(read_kernel_text("/proc/self/status"));
  std::string word;
  std::int64_t kibibytes = 0;
  while (lines >> word) {
    if (word == "VmHWM:" && lines >> kibibytes) return kibibytes * 1024;
    lines.ignore(1 << 20, '\n');
  }
  return std::nullopt;
}

}  // namespace

ProcessLoad process_load() {
  return {available_threads(), most_resident_bytes()};
}

}  // namespace herr
