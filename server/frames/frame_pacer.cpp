#include "server/frames/frame_pacer.h"

#include <algorithm>
#include <cmath>

namespace herr {

FramePacer::FramePacer(TimeNs origin_ns, double period_ns, std::int64_t first, std::int64_t count)
    : origin_ns_(origin_ns), period_ns_(period_ns), first_(first), end_(first + count), current_(first - 1) {}

TimeNs FramePacer::tick_ns(std::int64_t frame) const {
  return origin_ns_ + std::llround(static_cast<double>(frame - first_) * period_ns_);
}

// The quotient is off by less than one; the rounded ticks decide.
std::int64_t FramePacer::last_tick_at(TimeNs now_ns) const {
  auto frame =
      first_ + static_cast<std::int64_t>(std::floor(static_cast<double>(now_ns - origin_ns_) / period_ns_));
  while (tick_ns(frame) > now_ns) --frame;
  while (tick_ns(frame + 1) <= now_ns) ++frame;
  return frame;
}

std::int64_t FramePacer::first_tick_from(TimeNs now_ns) const {
  const std::int64_t before = last_tick_at(now_ns);
  return tick_ns(before) == now_ns ? before : before + 1;
}

std::optional<FramePacer::Begin> FramePacer::begin(TimeNs now_ns) {
  const std::int64_t frame = std::max(current_ + 1, last_tick_at(now_ns));
  if (frame >= end_) {
    dropped_at_end_ = std::max<std::int64_t>(end_ - 1 - current_, 0);
    current_ = end_ - 1;
    return std::nullopt;
  }
  Begin begin;
  begin.frame = frame;
  begin.due_ns = tick_ns(frame);
  begin.dropped = frame - current_ - 1;
  current_ = frame;
  return begin;
}

FramePacer::Outcome FramePacer::finish(TimeNs started_ns, TimeNs finished_ns) {
  Outcome outcome;
  outcome.missed = static_cast<double>(finished_ns - started_ns) > period_ns_;
  // A frame cannot be shown at the tick at which it begins.
  const std::int64_t tick = std::max(first_tick_from(finished_ns), current_ + 1);
  if (shown_tick_) outcome.repeated = std::max<std::int64_t>(tick - *shown_tick_ - 1, 0);
  shown_tick_ = tick;
  outcome.presentation_ns = tick_ns(tick);
  outcome.shown_after_ms = static_cast<double>(outcome.presentation_ns - tick_ns(current_)) * 1e-6;
  return outcome;
}

}  // namespace herr
