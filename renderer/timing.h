// The wall time of a piece of work, and the median of several. Before: measured code. After: bench and check.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

namespace herr {

// Milliseconds.
template <typename Work>
double wall_ms(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// Of an even number of values the mean of the two in the middle; 0 of none.
inline double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

}  // namespace herr
