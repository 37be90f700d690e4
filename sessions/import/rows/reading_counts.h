// What reading the values of a stream's rows had to put right. Before: the readers of this folder.
// After: import_report.
#pragma once

#include <cstdint>

namespace herr {

struct ReadingCounts {
  std::int64_t normalised = 0;  // quaternions, directions or matrices off by more than rounding
};

}  // namespace herr
