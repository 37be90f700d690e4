// The work of a period that stands beside the frame time: sampling the session, moving the scene, further
// views. Counted as CPU time, since a machine that takes cores away lengthens the wall time of all of it.
// Before: FrameStep says what begins and ends. After: MissFacts.
// Source: clock_gettime(2), CLOCK_THREAD_CPUTIME_ID.
#pragma once

#include <cstdint>
#include <optional>

namespace herr {

// CPU time of the calling thread since it began; waiting for a core, a file or another thread is not in it.
// Costs under a microsecond. None where the kernel does not tell.
std::optional<std::int64_t> thread_cpu_ns();

// Not thread-safe: all calls of a period come from the thread that samples. Allocates nothing.
class WorkBeside {
 public:
  void begin_sampling();
  // The scene is at the time of the frame, too.
  void end_sampling();
  void begin_rendering();
  void end_rendering();
  // CPU time in milliseconds of all that is beside the frame: of this thread while it sampled, and of the
  // process while it rendered beyond the frame's own `frame_cpu_ms`, spread over `threads` evenly. What the
  // kernel does not tell is 0, the least that it can be.
  double cpu_ms(std::optional<double> frame_cpu_ms, int threads) const;

 private:
  std::optional<std::int64_t> sampling_start_ns_, rendering_start_ns_;
  double sampling_ms_ = 0, rendering_ms_ = 0;
};

}  // namespace herr
