// What the hypervisor took: CPU time that this machine asked for and did not get, as the kernel counts it
// (/proc/stat). Before: read at both ends of a run. After: noise.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace herr {

// Ticks of all CPUs together since the machine was started.
struct CpuTicks {
  std::int64_t used = 0;    // anything but idle and waiting for disks
  std::int64_t stolen = 0;  // asked for and given to another machine
};

// The first line of /proc/stat; none where it cannot be read.
std::optional<CpuTicks> parse_cpu_ticks(const std::string& proc_stat);
std::optional<CpuTicks> read_cpu_ticks();

}  // namespace herr
