#include "sessions/inspect/frame_ages.h"

#include <algorithm>
#include <cmath>

namespace herr {
namespace {
// Frames that wait for one sample and are judged one by one; of more (hours without a sample) every n-th
// stands for n.
constexpr std::int64_t kJudgedSingly = 100'000;
}  // namespace

FrameAges::FrameAges(TimeNs start_ns, double display_hz, TimeNs forget_ns)
    : start_ns_(start_ns), period_ns_(1e9 / display_hz), forget_ns_(forget_ns) {}

// As replay places its frames.
TimeNs FrameAges::time_ns(std::int64_t frame) const {
  return start_ns_ + std::llround(static_cast<double>(frame) * period_ns_);
}

void FrameAges::judge(std::int64_t frames, TimeNs t_ns) {
  const bool usable = newest_ns_ && (forget_ns_ == 0 || t_ns - *newest_ns_ < forget_ns_);
  if (usable)
    ages_.count(std::max<TimeNs>(0, t_ns - *newest_ns_), 0, frames);
  else
    without_ += frames;
  frame_ += frames;
}

void FrameAges::judge_until(TimeNs last_ns) {
  if (time_ns(frame_) > last_ns) return;
  const auto waiting = static_cast<std::int64_t>(static_cast<double>(last_ns - time_ns(frame_)) / period_ns_);
  const std::int64_t step = std::max<std::int64_t>(1, waiting / kJudgedSingly);
  while (time_ns(frame_ + step - 1) <= last_ns) judge(step, time_ns(frame_ + step - 1));
  while (time_ns(frame_) <= last_ns) judge(1, time_ns(frame_));
}

void FrameAges::sample(TimeNs stamp_ns, std::optional<TimeNs> end_ns) {
  judge_until(std::min(stamp_ns - 1, end_ns.value_or(stamp_ns)));
  newest_ns_ = stamp_ns;
}

void FrameAges::finish(TimeNs end_ns) {
  judge_until(end_ns);
}

}  // namespace herr
