#include "sessions/camera/half_from_samples.h"

#include <Imath/half.h>

#include <cmath>

namespace herr {
namespace {

std::uint16_t bits(double value) {
  return Imath::half(static_cast<float>(value)).bits();
}

}  // namespace

double linear_from_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

const std::array<std::uint16_t, 256>& half_from_srgb8() {
  static const std::array<std::uint16_t, 256> table = [] {
    std::array<std::uint16_t, 256> made{};
    for (std::size_t i = 0; i < made.size(); ++i)
      made[i] = bits(linear_from_srgb(static_cast<double>(i) / 255.0));
    return made;
  }();
  return table;
}

const std::vector<std::uint16_t>& half_from_srgb16() {
  static const std::vector<std::uint16_t> table = [] {
    std::vector<std::uint16_t> made(65536);
    for (std::size_t i = 0; i < made.size(); ++i)
      made[i] = bits(linear_from_srgb(static_cast<double>(i) / 65535.0));
    return made;
  }();
  return table;
}

std::uint16_t half_from_linear(float value, std::int64_t& sanitised) {
  if (value >= 0 && value <= kLargestHalf) return Imath::half(value + 0.0f).bits();  // -0 + 0 = +0
  ++sanitised;
  return value > 0 ? Imath::half(kLargestHalf).bits() : std::uint16_t{0};
}

}  // namespace herr
