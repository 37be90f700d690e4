// Why a frame missed its display period: its own work, or a machine that gave its threads too little of the
// cores. Before: a frame's wall time, CPU time and preemptions. After: FrameRecord::cause.
// Rule: a frame was kept off the cores where the scheduler took a core from a thread of the process during it
// and its threads were on a core for less than kBusyShare of the time that they could have been. Its work
// fits where its CPU time, spread over the threads evenly, and the CPU time of what stands beside it take no
// more than the period.
//   machine: kept off, and the work fits: without the waiting it would have been in time
//   both:    kept off, and the work does not fit: neither less waiting nor less work would have done alone
//   work:    not kept off
// What no count here tells: cores that others slow down without taking them (memory, clock rate, a
// hypervisor) make the CPU time itself longer and read as work; a frame that many threads cannot share evenly
// may read as kept off when it is preempted, too.
#pragma once

#include <cstdint>
#include <optional>

namespace herr {

enum class MissCause : std::uint8_t { none, work, machine, both };
inline constexpr int kMissCauses = 4;
// "", "work", "machine", "both".
const char* name_of(MissCause cause);

inline constexpr double kBusyShare = 0.8;

struct MissFacts {
  double frame_ms = 0;  // wall time of the frame, further views aside
  // CPU time of what the period holds besides: sampling the session on one thread, further views spread over
  // all. Never wall time, which a machine that takes cores lengthens; 0, the least, where it is not known.
  double beside_cpu_ms = 0;
  double period_ms = 0;
  std::optional<double> cpu_ms;             // of the process during frame_ms
  std::optional<std::int64_t> preemptions;  // likewise
  int threads = 1;                          // that render, as far as there are cores for them
};

// Of a frame that missed. Where the kernel did not tell, the work.
MissCause cause_of_miss(const MissFacts& facts);

}  // namespace herr
