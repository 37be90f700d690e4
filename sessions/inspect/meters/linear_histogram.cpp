#include "sessions/inspect/meters/linear_histogram.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace herr {

LinearHistogram::LinearHistogram(double width, int steps)
    : width_(width), counts_(static_cast<std::size_t>(steps)) {}

void LinearHistogram::add(double value) {
  const double last = static_cast<double>(counts_.size() - 1);
  ++counts_[static_cast<std::size_t>(std::clamp(value / width_, 0.0, last))];
  ++count_;
  max_ = std::max(max_, value);
}

double LinearHistogram::quantile(double fraction) const {
  const auto rank =
      std::max<std::int64_t>(1, std::llround(std::ceil(fraction * static_cast<double>(count_))));
  if (rank >= count_) return max_;
  std::int64_t seen = 0;
  for (std::size_t step = 0; step < counts_.size(); ++step) {
    seen += counts_[step];
    if (seen >= rank) return std::min(max_, (static_cast<double>(step) + 0.5) * width_);
  }
  return max_;
}

}  // namespace herr
