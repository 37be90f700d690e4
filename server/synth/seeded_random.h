// Random numbers that are the same on every platform: the engine of the standard library (its sequence is
// fixed), but none of its distributions (theirs are not).
#pragma once

#include <cstdint>
#include <random>

namespace herr {

class SeededRandom {
 public:
  // Streams of one seed are independent: one for each thing that varies.
  SeededRandom(std::uint64_t seed, std::uint64_t stream) : engine_(mixed(seed, stream)) {}

  // Uniform in [lowest, highest).
  double uniform(double lowest, double highest) {
    const double unit = static_cast<double>(engine_() >> 11) * 0x1.0p-53;
    return lowest + (highest - lowest) * unit;
  }

 private:
  // SplitMix64's finaliser: neighbouring seeds give unrelated engines.
  static std::uint64_t mixed(std::uint64_t seed, std::uint64_t stream) {
    std::uint64_t x = seed * 0x9E3779B97F4A7C15u + stream + 1;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
  }

  std::mt19937_64 engine_;
};

}  // namespace herr
