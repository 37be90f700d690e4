// Half-float bit patterns to 8-bit sRGB (IEC 61966-2-1, the exact curve), by a table over all 65536 patterns.
// Before: linear-light pictures of the renderer. After: PNG files.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/viewport_image.h"

namespace herr {

// Linear light to encoded value, both in [0, 1]; inputs outside are clamped. Its inverse is
// linear_from_srgb() of sessions/camera/half_from_samples.h.
double srgb_from_linear(double linear);

// round(255 * srgb_from_linear(h * exposure)) of every pattern h; below 0 and NaN give 0, above 1 and +Inf
// give 255. Made when an exposure (ViewportImage::exposure) is first asked for, and kept: a run has one.
// Thread-safe.
using Srgb8Table = std::array<std::uint8_t, 65536>;
const Srgb8Table& srgb8_of_half(float exposure = 1);

// The greatest pattern of a finite half h with h * exposure <= 1 + 2^-11: what lies above it is clipped.
std::uint16_t white_half(float exposure);
// The greatest pattern of a half h with h * exposure <= 1 / (2 * 255 * 12.92), half an 8-bit step above
// black: what lies below 0 by no more is shown within its rounding, and is not clipped.
std::uint16_t black_half(float exposure);

float float_from_half(std::uint16_t bits);
std::uint16_t half_from_float(float value);
inline bool half_is_finite(std::uint16_t bits) {
  return (bits & 0x7C00u) != 0x7C00u;
}

// 8-bit sRGB pixels, rows from the top, no padding; alpha (4 channels) is unassociated, as PNG defines.
struct Srgb8Image {
  int width_px = 0, height_px = 0, channels = 3;
  std::vector<std::uint8_t> values;
  std::int64_t nonfinite_values = 0;  // NaN or Inf found in the source: a fault, shown as a warning
  // Pixels of finite values with a colour, as shown, above 1 by more than the rounding of a half (2^-11), or
  // below 0 by more than that of 8 bits (1.5e-4): an 8-bit picture shows 255 or 0 there.
  std::int64_t clipped_pixels = 0;
};

// With alpha: colours are divided by alpha, through half precision (error < 0.03 of an 8-bit step). Without:
// the premultiplied colours as they are, i.e. over black. `out` keeps its storage.
void srgb8_from_viewport(const ViewportImage& image, bool with_alpha, Srgb8Image& out);

}  // namespace herr
