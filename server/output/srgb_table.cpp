#include "server/output/srgb_table.h"

#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>

namespace herr {

double srgb_from_linear(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

float float_from_half(std::uint16_t bits) {
  return imath_half_to_float(bits);
}

std::uint16_t half_from_float(float value) {
  return imath_float_to_half(value);
}

const Srgb8Table& srgb8_of_half(float exposure) {
  static std::mutex mutex;
  static std::map<float, Srgb8Table> tables;
  const std::lock_guard lock(mutex);
  const auto [entry, added] = tables.try_emplace(exposure);
  if (!added) return entry->second;
  for (std::uint32_t bits = 0; bits < 65536; ++bits) {
    const double linear = double{float_from_half(static_cast<std::uint16_t>(bits))} * double{exposure};
    const double encoded = std::isnan(linear) ? 0.0 : srgb_from_linear(linear);
    entry->second[bits] = static_cast<std::uint8_t>(std::lround(255.0 * encoded));
  }
  return entry->second;
}

namespace {

constexpr std::uint16_t kHalfOne = 0x3C00;

std::uint8_t unit8(float value) {
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

// One texel with alpha: unassociated colour, then alpha.
void write_unassociated(const Srgb8Table& table, const std::uint16_t* texel, std::uint8_t* pixel) {
  const float alpha = half_is_finite(texel[3]) ? float_from_half(texel[3]) : 0.0f;
  for (int c = 0; c < 3; ++c) {
    if (texel[3] == kHalfOne) {
      pixel[c] = table[texel[c]];
    } else {
      pixel[c] = alpha > 0.0f ? table[half_from_float(float_from_half(texel[c]) / alpha)] : std::uint8_t{0};
    }
  }
  pixel[3] = unit8(alpha);
}

}  // namespace

void srgb8_from_viewport(const ViewportImage& image, bool with_alpha, Srgb8Image& out) {
  const auto width = static_cast<std::size_t>(image.width_px);
  out.width_px = image.width_px;
  out.height_px = image.height_px;
  out.channels = with_alpha ? 4 : 3;
  out.nonfinite_values = 0;
  out.values.resize(width * static_cast<std::size_t>(image.height_px) *
                    static_cast<std::size_t>(out.channels));
  const Srgb8Table& table = srgb8_of_half(image.exposure);
  std::uint8_t* pixel = out.values.data();
  for (int y = 0; y < image.height_px; ++y) {
    const std::uint16_t* texel = image.row(y);
    for (std::size_t x = 0; x < width; ++x, texel += 4, pixel += out.channels) {
      if (with_alpha) {
        write_unassociated(table, texel, pixel);
      } else {
        for (int c = 0; c < 3; ++c) pixel[c] = table[texel[c]];
      }
      for (int c = 0; c < 4; ++c) out.nonfinite_values += half_is_finite(texel[c]) ? 0 : 1;
    }
  }
}

}  // namespace herr
