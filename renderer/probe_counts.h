// How many probes there are in which state in a frame, and how much the light around them changes.
#pragma once

#include <cstdint>

namespace herr {

struct ProbeCounts {
  std::int64_t active = 0;     // updated when their turn comes
  std::int64_t relocated = 0;  // of all, moved off their grid point
  std::int64_t inactive = 0;   // far from everything, or in the dark
  std::int64_t updated = 0;    // in this frame
  std::int64_t reacting = 0;   // of these, those that met a large change
  double variability = 0;      // mean change of those updated, [0, 1]
};

}  // namespace herr
