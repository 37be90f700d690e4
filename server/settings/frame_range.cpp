#include "server/settings/frame_range.h"

#include <algorithm>
#include <cmath>

namespace herr {
namespace {

// The first frame whose stamp is not before `offset_ns` after the session's start.
std::int64_t first_frame_at(const FrameRange& range, double offset_ns) {
  auto frame = static_cast<std::int64_t>(offset_ns * 1e-9 * range.display_hz);
  // The product is off by less than one frame; stamps decide.
  frame = std::max<std::int64_t>(frame - 1, 0);
  while (static_cast<double>(range.time_ns(frame) - range.session_start_ns) < offset_ns) ++frame;
  return frame;
}

}  // namespace

TimeNs FrameRange::time_ns(std::int64_t frame) const {
  return session_start_ns + std::llround(static_cast<double>(frame) * (1e9 / display_hz));
}

FrameRange frames_to_replay(TimeNs start_ns, TimeNs end_ns, double display_hz,
                            const FrameRangeRequest& request) {
  FrameRange range;
  range.session_start_ns = start_ns;
  range.display_hz = display_hz;
  const auto length_ns = static_cast<double>(end_ns - start_ns);
  // Seconds of the command line to whole nanoseconds, so that "0.1" means the stamp 100000000.
  const double offset_ns = std::round(request.start_s * 1e9);
  range.first = first_frame_at(range, std::min(offset_ns, length_ns + 1.0));
  std::int64_t end = first_frame_at(range, length_ns + 1.0);  // the last frame may lie on end_ns itself
  if (request.duration_s) {
    const double stop_ns = std::round((request.start_s + *request.duration_s) * 1e9);
    end = std::min(end, first_frame_at(range, std::min(stop_ns, length_ns + 1.0)));
  }
  range.count = std::max<std::int64_t>(end - range.first, 0);
  if (request.frames) range.count = std::min(range.count, *request.frames);
  return range;
}

}  // namespace herr
