// Random numbers that are the same on every platform: the engine of the standard library (its sequence is
// fixed), but none of its distributions (theirs are not).
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace herr {

namespace seeded_random {

// SplitMix64's finaliser: neighbouring numbers give unrelated ones.
inline std::uint64_t mixed(std::uint64_t seed, std::uint64_t stream) {
  std::uint64_t x = seed * 0x9E3779B97F4A7C15u + stream + 1;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

inline double within(std::uint64_t bits, double lowest, double highest) {
  const double unit = static_cast<double>(bits >> 11) * 0x1.0p-53;
  return lowest + (highest - lowest) * unit;
}

}  // namespace seeded_random

// Not thread-safe.
class SeededRandom {
 public:
  // Streams of one seed are independent: one for each thing that varies.
  SeededRandom(std::uint64_t seed, std::uint64_t stream) : engine_(seeded_random::mixed(seed, stream)) {}

  // Uniform in [lowest, highest).
  double uniform(double lowest, double highest) { return seeded_random::within(engine_(), lowest, highest); }
  // Mean 0, deviation 1 (Box and Muller 1958; one of the pair is enough).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0, 1)));
    return radius * std::cos(2.0 * std::numbers::pi * uniform(0, 1));
  }
  // Half of the values below `median`; `sigma`: deviation of the logarithm.
  double log_normal(double median, double sigma) { return median * std::exp(sigma * normal()); }
  double exponential(double mean) { return -mean * std::log(1.0 - uniform(0, 1)); }

 private:
  std::mt19937_64 engine_;
};

// The number of one element of a sequence, whichever elements were asked for before:
// uniform in [lowest, highest).
inline double keyed_uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t index, double lowest,
                            double highest) {
  return seeded_random::within(seeded_random::mixed(seeded_random::mixed(seed, stream), index), lowest,
                               highest);
}

}  // namespace herr
