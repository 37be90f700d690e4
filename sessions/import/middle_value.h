// The median of a list. Before: values in any order. After: steps between stamps, lenses of a recording.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace herr {

// Of an even number of values the larger of the two in the middle. `values` is not empty.
template <typename T>
T middle_value(std::vector<T> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace herr
