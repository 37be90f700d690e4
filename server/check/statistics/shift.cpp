#include "server/check/statistics/shift.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace herr {

Shift shift_of(std::vector<double>& comparisons, int outside) {
  std::sort(comparisons.begin(), comparisons.end());
  const std::size_t count = comparisons.size();
  Shift shift;
  shift.estimate = 0.5 * (comparisons[(count - 1) / 2] + comparisons[count / 2]);
  // Bounds are the outside-th values from either end; none where the test never gets that sure.
  shift.lower = -std::numeric_limits<double>::infinity();
  shift.upper = std::numeric_limits<double>::infinity();
  if (outside > 0 && static_cast<std::size_t>(outside) <= count) {
    shift.lower = comparisons[static_cast<std::size_t>(outside) - 1];
    shift.upper = comparisons[count - static_cast<std::size_t>(outside)];
  }
  return shift;
}

}  // namespace herr
