// Stored samples to linear light as IEEE half bit patterns: the sRGB curve (IEC 61966-2-1) by table, floats
// by clamping. Before: the image decoder. After: CameraImage.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace herr {

inline constexpr std::uint16_t kHalfOne = 0x3c00;
inline constexpr float kLargestHalf = 65504.0f;

// The linear value of an sRGB-encoded value in [0, 1].
double linear_from_srgb(double encoded);

const std::array<std::uint16_t, 256>& half_from_srgb8();
const std::vector<std::uint16_t>& half_from_srgb16();  // 65536 entries

// A linear float as half. NaN and negative become 0, infinite and too large 65504; each of
// those counts in `sanitised`.
std::uint16_t half_from_linear(float value, std::int64_t& sanitised);

}  // namespace herr
