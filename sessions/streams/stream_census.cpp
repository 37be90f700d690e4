#include "sessions/streams/stream_census.h"

#include <string>

namespace herr {
namespace {

constexpr TimeNs kClosestNs = 100'000;          // 10 kHz: ten times the fastest head tracker
constexpr TimeNs kFurthestNs = 10'000'000'000;  // 0.1 Hz
constexpr TimeNs kGapNs = 1'000'000'000;        // a second without word is no hitch any more

}  // namespace

void StreamCensus::count(TimeNs stamp_ns, std::int64_t line) {
  if (rows_++ == 0) {
    first_ns_ = last_ns_ = stamp_ns;
    return;
  }
  const TimeNs step_ns = stamp_ns - last_ns_;
  last_ns_ = stamp_ns;
  if (step_ns < kClosestNs) ++too_close_;
  if (step_ns > kFurthestNs) ++too_far_;
  if (step_ns > kGapNs) ++gaps_;
  if (step_ns > widest_ns_) {
    widest_ns_ = step_ns;
    widest_line_ = line;
  }
}

void StreamCensus::check_rate(const std::filesystem::path& file, bool slow_refused) const {
  const std::int64_t steps = rows_ - 1;
  if (2 * too_close_ > steps)
    throw InputError(file, 0, "most samples are less than 0.1 ms apart (over 10 kHz)",
                     "stamps are in nanoseconds: multiply microseconds by 1000");
  if (slow_refused && 2 * too_far_ > steps)
    throw InputError(file, 0, "most samples are more than 10 s apart (under 0.1 Hz)",
                     "stamps are in nanoseconds: check their unit");
}

std::optional<InputError> StreamCensus::gap_warning(const std::filesystem::path& file) const {
  if (gaps_ == 0) return std::nullopt;
  const std::string widest_ms = std::to_string(widest_ns_ / 1'000'000);
  return InputError(file, widest_line_,
                    gaps_ == 1
                        ? "a gap of " + widest_ms + " ms ends here"
                        : "the widest of " + std::to_string(gaps_) + " gaps, " + widest_ms + " ms, ends here",
                    "the last sample is held across a gap");
}

}  // namespace herr
