#include "server/bench/session_sequence.h"

#include <algorithm>

namespace herr {

std::vector<std::int64_t> spread_frames(const FrameRange& range, int count) {
  const std::int64_t parts = std::min<std::int64_t>(count, range.count);
  std::vector<std::int64_t> numbers;
  // (i + 1/2) / parts of the range, in whole numbers.
  for (std::int64_t i = 0; i < parts; ++i)
    numbers.push_back(range.first + (2 * i + 1) * range.count / (2 * parts));
  return numbers;
}

}  // namespace herr
