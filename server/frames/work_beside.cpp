#include "server/frames/work_beside.h"

#include <algorithm>
#include <ctime>

#include "renderer/threads/cpu_use.h"

namespace herr {
namespace {

double ms_since(std::optional<std::int64_t> start_ns, std::optional<std::int64_t> now_ns) {
  return start_ns && now_ns ? static_cast<double>(*now_ns - *start_ns) * 1e-6 : 0;
}

}  // namespace

std::optional<std::int64_t> thread_cpu_ns() {
  timespec used{};
  if (::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used) != 0) return std::nullopt;
  return std::int64_t{used.tv_sec} * 1'000'000'000 + used.tv_nsec;
}

void WorkBeside::begin_sampling() {
  sampling_start_ns_ = thread_cpu_ns();
}

void WorkBeside::end_sampling() {
  sampling_ms_ = ms_since(sampling_start_ns_, thread_cpu_ns());
}

void WorkBeside::begin_rendering() {
  rendering_start_ns_ = process_cpu_ns();
}

void WorkBeside::end_rendering() {
  rendering_ms_ = ms_since(rendering_start_ns_, process_cpu_ns());
}

double WorkBeside::cpu_ms(std::optional<double> frame_cpu_ms, int threads) const {
  if (!frame_cpu_ms) return sampling_ms_;
  return sampling_ms_ + std::max(0.0, rendering_ms_ - *frame_cpu_ms) / std::max(1, threads);
}

}  // namespace herr
