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

// The greatest pattern of a finite half that is no greater than `most`.
std::uint16_t half_below(double most) {
  std::uint16_t low = 0, high = 0x7BFF;  // 0 and the greatest finite half
  while (low < high) {
    const auto middle = static_cast<std::uint16_t>((low + high + 1) / 2);
    if (double{float_from_half(middle)} <= most) {
      low = middle;
    } else {
      high = static_cast<std::uint16_t>(middle - 1);
    }
  }
  return low;
}

}  // namespace

std::uint16_t white_half(float exposure) {
  return half_below((1.0 + std::exp2(-11)) / double{exposure});
}

std::uint16_t black_half(float exposure) {
  return half_below(1.0 / (2 * 255 * 12.92) / double{exposure});
}

namespace {

constexpr std::uint16_t kHalfOne = 0x3C00, kHalfSign = 0x8000;

std::uint8_t unit8(float value) {
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

struct ShownTexel {
  std::array<std::uint16_t, 3> colour;  // unassociated where alpha counts
  float alpha = 1;
};

ShownTexel unassociated(const std::uint16_t* texel) {
  ShownTexel result{{texel[0], texel[1], texel[2]},
                    half_is_finite(texel[3]) ? float_from_half(texel[3]) : 0.0f};
  if (texel[3] == kHalfOne) return result;
  for (std::uint16_t& colour : result.colour)
    colour = result.alpha > 0.0f ? half_from_float(float_from_half(colour) / result.alpha) : std::uint16_t{0};
  return result;
}

// Above `white`, or below -`black`.
bool is_clipped(const ShownTexel& texel, std::uint16_t white, std::uint16_t black) {
  return std::any_of(texel.colour.begin(), texel.colour.end(), [white, black](std::uint16_t bits) {
    return bits > ((bits & kHalfSign) != 0 ? kHalfSign + black : white);
  });
}

}  // namespace

void srgb8_from_viewport(const ViewportImage& image, bool with_alpha, Srgb8Image& out) {
  const auto width = static_cast<std::size_t>(image.width_px);
  out.width_px = image.width_px;
  out.height_px = image.height_px;
  out.channels = with_alpha ? 4 : 3;
  out.nonfinite_values = out.clipped_pixels = 0;
  out.values.resize(width * static_cast<std::size_t>(image.height_px) *
                    static_cast<std::size_t>(out.channels));
  const Srgb8Table& table = srgb8_of_half(image.exposure);
  const std::uint16_t white = white_half(image.exposure), black = black_half(image.exposure);
  std::uint8_t* pixel = out.values.data();
  for (int y = 0; y < image.height_px; ++y) {
    const std::uint16_t* bits = image.row(y);
    for (std::size_t x = 0; x < width; ++x, bits += 4, pixel += out.channels) {
      const ShownTexel texel = with_alpha ? unassociated(bits) : ShownTexel{{bits[0], bits[1], bits[2]}};
      for (std::size_t c = 0; c < 3; ++c) pixel[c] = table[texel.colour[c]];
      if (with_alpha) pixel[3] = unit8(texel.alpha);
      int nonfinite = 0;
      for (int c = 0; c < 4; ++c) nonfinite += half_is_finite(bits[c]) ? 0 : 1;
      out.nonfinite_values += nonfinite;
      out.clipped_pixels += nonfinite == 0 && is_clipped(texel, white, black) ? 1 : 0;
    }
  }
}

}  // namespace herr
