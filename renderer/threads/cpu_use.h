// What this process has of the CPU: how many cores it may use, and the time that its threads have spent on
// them. Before: the kernel. After: the frame, which is timed by it; reports.
// Source: clock_gettime(2), CLOCK_PROCESS_CPUTIME_ID; sched_getaffinity(2); cgroup v2 "cpu.max".
#pragma once

#include <cstdint>
#include <optional>

namespace herr {

// The number of threads this process may use: its CPU affinity, narrowed by a cgroup CPU quota.
int available_threads();

// CPU time of all threads of this process since it began, user and system, those at work included. Costs a
// microsecond or so. None where the kernel does not tell.
std::optional<std::int64_t> process_cpu_ns();

}  // namespace herr
