// IEEE half bit patterns of finite values that are not negative, one at a time. Vectors of them are the
// kernels' business.
#pragma once

#include <bit>
#include <cstdint>

namespace herr {

inline float value_of_half(std::uint16_t bits) {
  constexpr std::uint16_t kFirstNormal = 0x400;
  constexpr std::uint32_t kExponentBias = 127 - 15;
  if (bits < kFirstNormal) return static_cast<float>(bits) * 0x1p-24f;
  return std::bit_cast<float>((std::uint32_t{bits} << 13) + (kExponentBias << 23));
}

}  // namespace herr
