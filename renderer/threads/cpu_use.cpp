#include "renderer/threads/cpu_use.h"

#include <sys/resource.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <sstream>
#include <string>

#include "sessions/files/input_file.h"

namespace herr {
namespace {

// cgroup v2 "cpu.max" holds "QUOTA PERIOD" in microseconds, or "max PERIOD".
int cgroup_quota_threads() {
  std::istringstream file(read_kernel_text("/sys/fs/cgroup/cpu.max"));
  std::string quota;
  double period = 0;
  if (!(file >> quota >> period) || quota == "max" || period <= 0) return 1 << 20;
  return std::max(1, static_cast<int>(std::ceil(std::strtod(quota.c_str(), nullptr) / period)));
}

}  // namespace

int available_threads() {
  return std::clamp(std::min(tbb::info::default_concurrency(), cgroup_quota_threads()), 1, 512);
}

std::optional<std::int64_t> process_cpu_ns() {
  timespec used{};
  if (::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used) != 0) return std::nullopt;
  return std::int64_t{used.tv_sec} * 1'000'000'000 + used.tv_nsec;
}

std::optional<std::int64_t> process_preemptions() {
  rusage use{};
  if (::getrusage(RUSAGE_SELF, &use) != 0) return std::nullopt;
  return std::int64_t{use.ru_nivcsw};
}

}  // namespace herr
