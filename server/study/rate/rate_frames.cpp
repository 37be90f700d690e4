#include "server/study/rate/rate_frames.h"

#include <algorithm>

namespace herr {
namespace {

constexpr std::int64_t kStretches = 4, kWarmUp = 5, kStretch = kWarmUp + kRateFrames / kStretches;

}  // namespace

std::vector<RateFrame> rate_frames(const FrameRange& range) {
  std::vector<RateFrame> frames;
  const bool whole = range.count < kStretches * kStretch;
  const std::int64_t stretches = whole ? 1 : kStretches, length = whole ? range.count : kStretch,
                     warm_up = std::min(kWarmUp, length / 2);
  for (std::int64_t s = 0; s < stretches; ++s) {
    // In the middle of its share of the range.
    const std::int64_t begin = range.first + (2 * s + 1) * range.count / (2 * stretches) - length / 2;
    for (std::int64_t i = 0; i < length; ++i) {
      frames.push_back({whole ? range.first + i : begin + i, i >= warm_up, static_cast<int>(s)});
    }
  }
  return frames;
}

bool CountedFrames::counts(const RateFrame& frame, double frame_ms) {
  const bool far = frame_ms > 4 * period_ms_;
  const bool again = far && was_far_;
  was_far_ = far;
  return frame.counts || again;
}

}  // namespace herr
