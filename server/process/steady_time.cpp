#include "server/process/steady_time.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace herr {
namespace {

constexpr TimeNs kStopCheckNs = 20'000'000;

}  // namespace

TimeNs steady_now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

bool sleep_until(TimeNs due_ns, const std::function<bool()>& stop) {
  for (;;) {
    if (stop()) return false;
    const TimeNs left_ns = due_ns - steady_now_ns();
    if (left_ns <= 0) return true;
    std::this_thread::sleep_for(std::chrono::nanoseconds(std::min(left_ns, kStopCheckNs)));
  }
}

}  // namespace herr
