// What this process takes of the machine that no single frame tells. Before: the kernel. After: summary.json,
// bench, GET /v1/status, /metrics.
#pragma once

#include <cstdint>
#include <optional>

namespace herr {

struct ProcessLoad {
  int cores = 0;  // that the process may use: CPU affinity, narrowed by a cgroup quota; 0: not asked yet
  // The most memory that was ever resident, of the whole process since it began: loading, every session and
  // renderer so far, and the libraries are in it. None where /proc cannot be read. VmHWM of proc(5): the
  // ru_maxrss of getrusage(2) may be that of the program that started this one.
  std::optional<std::int64_t> peak_resident_bytes;
};

ProcessLoad process_load();

}  // namespace herr
