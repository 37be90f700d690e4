#include "server/check/statistics/noise.h"

#include <boost/math/statistics/univariate_statistics.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "server/text/number_text.h"

namespace herr {
namespace {

std::string percent(double share) {
  return fixed_text(100 * share, 1) + " %";
}

}  // namespace

double robust_cv(std::span<const double> values) {
  if (values.size() < 2) return 0;
  // Not by the median_absolute_deviation of Boost 1.74: it answers the value at that
  // distance, not the distance.
  std::vector<double> work(values.begin(), values.end());
  const double middle = boost::math::statistics::median(work);
  for (double& x : work) x = std::abs(x - middle);
  return kSigmaPerDeviation * boost::math::statistics::median(work) / middle;
}

std::string noise_text(const Noise& noise) {
  if (std::isnan(noise.steal)) return "the kernel does not say what a hypervisor took of the CPU time";
  // Written so that what is not a number is too restless.
  if (!(noise.calibration_cv <= kMostCalibrationCv)) {
    return "the machine's speed varied by " + percent(noise.calibration_cv) + " from run to run (limit " +
           percent(kMostCalibrationCv) + ")";
  }
  if (!(noise.steal <= kMostSteal)) {
    return "the hypervisor took " + percent(noise.steal) + " of the CPU time (limit " + percent(kMostSteal) +
           ")";
  }
  return {};
}

double excused_shift(const Noise& noise) {
  // Written so that what is not a number excuses everything.
  if (!(noise.steal < 1 && noise.calibration_cv >= 0)) return std::numeric_limits<double>::infinity();
  return noise.calibration_cv - std::log1p(-noise.steal);
}

}  // namespace herr
