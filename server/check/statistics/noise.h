// Is the machine too restless for a verdict? A calibration that is the same work each time shows how the
// machine's speed changed from run to run, and the kernel counts what the hypervisor took.
// Before: the calibration and CPU times of every run. After: the verdict `noisy`.
#pragma once

#include <span>
#include <string>

namespace herr {

inline constexpr double kMostCalibrationCv = 0.05;
inline constexpr double kMostSteal = 0.05;
// Standard deviations of a normal distribution per median absolute deviation.
inline constexpr double kSigmaPerDeviation = 1.4826;

// Coefficient of variation that single wild values do not move: kSigmaPerDeviation median absolute deviations
// over the median. Rank tests live with single wild runs; this
// is for what they cannot see, a machine that is restless all the time. Positive values; 0 for less than two.
double robust_cv(std::span<const double> values);

struct Noise {
  double calibration_cv = 0;  // of the medians of runs
  double steal = 0;  // stolen CPU time over CPU time asked for, of all runs; not a number: the kernel is mute
};
// One line that says what is too restless; empty when nothing is.
std::string noise_text(const Noise& noise);
// How far a restless machine may have moved a shift (of logarithms) at most: by the standard deviation of its
// speed and by all that was stolen, had both fallen on one side of every pair, though the sides take turns.
// Infinite where the kernel is mute.
double excused_shift(const Noise& noise);

}  // namespace herr
