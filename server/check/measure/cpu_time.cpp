#include "server/check/measure/cpu_time.h"

#include <sstream>

#include "sessions/files/input_file.h"

namespace herr {

std::optional<CpuTicks> parse_cpu_ticks(const std::string& proc_stat) {
  std::istringstream words(proc_stat);
  std::string name;
  std::int64_t user = 0, nice = 0, system = 0, idle = 0, waiting = 0, interrupts = 0, soft = 0, stolen = 0;
  if (!(words >> name >> user >> nice >> system >> idle >> waiting >> interrupts >> soft >> stolen) ||
      name != "cpu") {
    return std::nullopt;
  }
  return CpuTicks{user + nice + system + interrupts + soft, stolen};
}

std::optional<CpuTicks> read_cpu_ticks() {
  return parse_cpu_ticks(read_kernel_text("/proc/stat"));
}

}  // namespace herr
