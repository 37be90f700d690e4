// Why a frame missed its display period: its own work, or a machine that gave its threads too little of the
// cores. Before: a frame's wall time, CPU time and preemptions. After: FrameRecord::cause.
// Rule: the machine, where all of these hold: the scheduler took a core from a thread of the process during
// the frame; the frame's threads were on a core for less than kBusyShare of the time that they could have
// been; and the work, spread over them evenly, fits into the period. Else the work.
// What no count here tells: cores that others slow down without taking them (memory, clock rate, a
// hypervisor) make the CPU time itself longer and read as work; a frame that many threads cannot share evenly
// may read as the machine when it is preempted, too.
#pragma once

#include <cstdint>
#include <optional>

namespace herr {

enum class MissCause : std::uint8_t { none, work, machine };
inline constexpr int kMissCauses = 3;
// "", "work", "machine".
const char* name_of(MissCause cause);

inline constexpr double kBusyShare = 0.8;

struct MissFacts {
  double frame_ms = 0;   // wall time of the frame, further views aside
  double beside_ms = 0;  // of the same period, on one thread: sampling the session, further views
  double period_ms = 0;
  std::optional<double> cpu_ms;             // of the process during frame_ms
  std::optional<std::int64_t> preemptions;  // likewise
  int threads = 1;                          // that render, as far as there are cores for them
};

// Of a frame that missed. Where the kernel did not tell, the work.
MissCause cause_of_miss(const MissFacts& facts);

}  // namespace herr
