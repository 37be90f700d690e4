// Means over the random numbers of many seeds: whether one estimator differs from another by more than
// chance, and how much it scatters. Before: pictures of seeds, as rows of values. After: samples_relations.
//
// Rows D_i = tested_i - reference_i are independent. Where both have the same mean, products <D_i, D_j> of
// two of them are uncorrelated and 0 in the mean; a difference d that all have adds |d|^2, wherever it is and
// whatever its sign. Errors are given in standard errors of a normal distribution.
// Source: Chen & Qin, "A two-sample test for high-dimensional data" (Annals of Statistics, 2010).
#pragma once

#include <span>
#include <vector>

namespace herr {

using SeedRows = std::vector<std::vector<float>>;  // one row per seed, all of one length

// Standard errors by which means differ.
struct MeanDifference {
  double local = 0;    // somewhere, in any direction
  double overall = 0;  // the mean of all values
  double share = 0;    // the overall difference, of the mean of all reference values

  double worst() const { return local > overall ? local : overall; }
};

// At least 3 rows each, as many of the one as of the other. Means may differ by `rounding` of each value
// without being called different. Values that are no numbers make every result no number.
MeanDifference mean_difference(const SeedRows& tested, const SeedRows& reference, double rounding);

// Root of the mean variance of values from one seed to another, and its standard error.
struct SeedNoise {
  double sigma = 0, standard_error = 0;
};
SeedNoise seed_noise(const SeedRows& rows);

double mean_of(const SeedRows& rows);

// The normal deviate that is as likely to be exceeded as F of so many degrees of freedom (Paulson 1942), and
// as |t| (Wallace 1959).
double normal_from_f(double f, double degrees, double degrees_below);
double normal_from_t(double t, double degrees);

}  // namespace herr
