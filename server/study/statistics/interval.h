// An estimate and where the truth lies with 95 % confidence.
#pragma once

#include <limits>

namespace herr {

struct Interval {
  double estimate = std::numeric_limits<double>::quiet_NaN();
  // Infinite where there is too little data for the confidence.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

}  // namespace herr
