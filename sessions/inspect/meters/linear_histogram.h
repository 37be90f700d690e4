// How often values of 0 and more occur, in steps of equal width: quantiles within half a step, constant
// memory. The unit is the caller's.
#pragma once

#include <cstdint>
#include <vector>

namespace herr {

class LinearHistogram {
 public:
  // Values of steps * width and more share the last step.
  LinearHistogram(double width, int steps);
  void add(double value);

  std::int64_t count() const { return count_; }
  double max() const { return max_; }  // exact; 0 when empty
  // Middle of the step of the nearest rank, no more than max(); 0 when empty. fraction in [0, 1].
  double quantile(double fraction) const;

 private:
  double width_;
  std::vector<std::int64_t> counts_;
  std::int64_t count_ = 0;
  double max_ = 0;
};

}  // namespace herr
