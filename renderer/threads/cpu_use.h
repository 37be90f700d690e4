// What this process has of the CPU: how many cores it may use, and the time that its threads have spent on
// them. Before: the kernel. After: the frame, which is timed by it; reports.
// Source: clock_gettime(2), CLOCK_PROCESS_CPUTIME_ID; getrusage(2), ru_nivcsw; sched_getaffinity(2); cgroup
// v2 "cpu.max".
#pragma once

#include <cstdint>
#include <optional>

namespace herr {

// The number of threads this process may use: its CPU affinity, narrowed by a cgroup CPU quota.
int available_threads();

// CPU time of all threads of this process since it began, user and system, those at work included. Costs a
// microsecond or so. None where the kernel does not tell.
std::optional<std::int64_t> process_cpu_ns();

// How often the scheduler has taken a core from a thread of this process that wanted to go on, since the
// process began: for another program, for another thread of this one, or at the end of a cgroup's quota.
// None where the kernel does not tell.
std::optional<std::int64_t> process_preemptions();

}  // namespace herr
