#include "renderer/geometry/texture_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace herr {
namespace {

double linear_of_srgb(double c) {  // IEC 61966-2-1
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// Value <-> light, both ways by table: the inverse finds the byte whose light is nearest.
class Transfer {
 public:
  explicit Transfer(bool srgb) {
    for (std::size_t i = 0; i < 256; ++i) {
      const double c = static_cast<double>(i) / 255.0;
      light_[i] = static_cast<float>(srgb ? linear_of_srgb(c) : c);
    }
    for (std::size_t i = 0; i < 255; ++i) edge_[i] = 0.5f * (light_[i] + light_[i + 1]);
  }
  float light(std::uint8_t value) const { return light_[value]; }
  std::uint8_t value(float light) const {
    return static_cast<std::uint8_t>(std::upper_bound(edge_.begin(), edge_.end(), light) - edge_.begin());
  }

 private:
  std::array<float, 256> light_{};
  std::array<float, 255> edge_{};
};

// The texels of a row of `from` that texel i of a row of `to` = max(1, from / 2) covers, and their shares.
struct Taps {
  int first = 0, count = 0;
  std::array<float, 3> share{};
};

Taps taps_of(int i, int from, int to) {
  Taps taps;
  const double scale = static_cast<double>(from) / to;  // 1, 2, or up to 3
  const double lower = i * scale, upper = (i + 1) * scale;
  taps.first = static_cast<int>(lower);
  for (int x = taps.first; x < from && x < upper - 1e-9 && taps.count < 3; ++x) {
    const double covered = std::min(upper, x + 1.0) - std::max(lower, static_cast<double>(x));
    taps.share[static_cast<std::size_t>(taps.count++)] = static_cast<float>(covered / scale);
  }
  return taps;
}

struct Level {
  int width, height;
  std::vector<float> rgba;  // light; alpha as it is
};

Level half_of(const Level& from, bool covers) {
  Level to{std::max(1, from.width / 2), std::max(1, from.height / 2), {}};
  to.rgba.resize(4 * static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height));
  std::vector<Taps> columns;
  for (int x = 0; x < to.width; ++x) columns.push_back(taps_of(x, from.width, to.width));
  float* out = to.rgba.data();
  for (int y = 0; y < to.height; ++y) {
    const Taps rows = taps_of(y, from.height, to.height);
    for (const Taps& column : columns) {
      std::array<float, 4> sum{}, plain{};
      for (int j = 0; j < rows.count; ++j) {
        for (int i = 0; i < column.count; ++i) {
          const float share =
              rows.share[static_cast<std::size_t>(j)] * column.share[static_cast<std::size_t>(i)];
          const float* texel = &from.rgba[4 * (static_cast<std::size_t>(rows.first + j) *
                                                   static_cast<std::size_t>(from.width) +
                                               static_cast<std::size_t>(column.first + i))];
          const float weight = covers ? share * texel[3] : share;
          for (std::size_t c = 0; c < 3; ++c) {
            sum[c] += weight * texel[c];
            plain[c] += share * texel[c];
          }
          sum[3] += share * texel[3];
        }
      }
      for (std::size_t c = 0; c < 3; ++c) {
        out[c] = !covers ? sum[c] : sum[3] > 0 ? sum[c] / sum[3] : plain[c];
      }
      out[3] = sum[3];
      out += 4;
    }
  }
  return to;
}

Level light_of(const TextureImage& image, const Transfer& colour, const Transfer& linear) {
  Level level{image.width_px, image.height_px, {}};
  level.rgba.resize(image.rgba.size());
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    level.rgba[i] = (i % 4 == 3 ? linear : colour).light(image.rgba[i]);
  }
  return level;
}

void append(const Level& level, const Transfer& colour, const Transfer& linear,
            std::vector<std::uint32_t>& texels) {
  for (std::size_t i = 0; i < level.rgba.size(); i += 4) {
    const std::uint8_t texel[4] = {colour.value(level.rgba[i]), colour.value(level.rgba[i + 1]),
                                   colour.value(level.rgba[i + 2]), linear.value(level.rgba[i + 3])};
    std::uint32_t word;
    std::memcpy(&word, texel, sizeof(word));
    texels.push_back(word);
  }
}

}  // namespace

TextureLevels build_levels(const TextureImage& image) {
  TextureLevels built;
  TextureRecord& record = built.record;
  record.width = image.width_px;
  record.height = image.height_px;
  record.srgb = image.srgb;
  record.wrap_u = static_cast<std::uint8_t>(image.wrap_u);
  record.wrap_v = static_cast<std::uint8_t>(image.wrap_v);
  record.nearest = image.nearest;
  const std::size_t pixels =
      static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
  if (image.rgba.size() != 4 * pixels)
    throw std::logic_error("a texture whose pixels were left out cannot be rendered");
  built.texels.reserve(pixels + pixels / 3 + 16);
  built.texels.resize(pixels);
  std::memcpy(built.texels.data(), image.rgba.data(), image.rgba.size());
  if (image.width_px > 1 || image.height_px > 1) {
    const Transfer colour(image.srgb), linear(false);
    Level level = light_of(image, colour, linear);
    while (level.width > 1 || level.height > 1) {
      level = half_of(level, image.covers);
      record.first_texel[static_cast<std::size_t>(record.levels++)] =
          static_cast<std::int32_t>(built.texels.size());
      append(level, colour, linear, built.texels);
    }
  }
  record.rgba8 = built.texels.data();  // moves along with the vector
  return built;
}

}  // namespace herr
