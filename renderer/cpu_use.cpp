#include "renderer/cpu_use.h"

#include <ctime>

namespace herr {

std::optional<std::int64_t> process_cpu_ns() {
  timespec used{};
  if (::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used) != 0) return std::nullopt;
  return std::int64_t{used.tv_sec} * 1'000'000'000 + used.tv_nsec;
}

}  // namespace herr
