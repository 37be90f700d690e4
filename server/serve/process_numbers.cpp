#include "server/serve/process_numbers.h"

#include <sys/resource.h>
#include <unistd.h>

#include <sstream>
#include <string>
#include <system_error>

#include "sessions/files/folders.h"
#include "sessions/files/input_file.h"

namespace herr {
namespace {

// Seconds since 1970 at which the machine was started.
std::optional<double> boot_time_seconds() {
  std::istringstream lines(read_kernel_text("/proc/stat"));
  std::string word;
  double value = 0;
  while (lines >> word) {
    if (word == "btime" && lines >> value) return value;
    lines.ignore(1 << 20, '\n');
  }
  return std::nullopt;
}

}  // namespace

std::optional<ProcessNumbers> read_process_numbers() {
  const std::string stat = read_kernel_text("/proc/self/stat");
  // The second field is the program's name in parentheses and may hold anything.
  const std::size_t name_end = stat.rfind(')');
  const std::optional<double> boot_s = boot_time_seconds();
  if (name_end == std::string::npos || !boot_s) return std::nullopt;
  std::istringstream fields(stat.substr(name_end + 1));
  std::string skipped;
  for (int field = 3; field < 14; ++field) fields >> skipped;
  double user = 0, system = 0, start = 0;
  std::int64_t virtual_bytes = 0, resident_pages = 0;
  fields >> user >> system;
  for (int field = 16; field < 22; ++field) fields >> skipped;
  fields >> start >> virtual_bytes >> resident_pages;
  if (!fields) return std::nullopt;

  ProcessNumbers numbers;
  const auto ticks = static_cast<double>(::sysconf(_SC_CLK_TCK));
  numbers.cpu_seconds = (user + system) / ticks;
  numbers.start_time_seconds = *boot_s + start / ticks;
  numbers.virtual_bytes = virtual_bytes;
  numbers.resident_bytes = resident_pages * ::sysconf(_SC_PAGESIZE);
  std::error_code error;
  numbers.open_descriptors = static_cast<std::int64_t>(list_folder("/proc/self/fd", error).size());
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) == 0) {
    numbers.most_descriptors = static_cast<std::int64_t>(limit.rlim_cur);
  }
  return numbers;
}

}  // namespace herr
