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
    for (std::size_t i = 0; i < below_.size(); ++i) {
      const float light = static_cast<float>(i) / kParts;
      below_[i] =
          static_cast<std::uint8_t>(std::upper_bound(edge_.begin(), edge_.end(), light) - edge_.begin());
    }
  }
  float light(std::uint8_t value) const { return light_[value]; }
  // As many as there are edges at or below the light: those below its part of [0, 1) are counted already.
  std::uint8_t value(float light) const {
    const auto part = static_cast<std::size_t>(std::clamp(light * kParts, 0.0f, kParts - 1.0f));
    std::uint8_t count = below_[part];
    while (count < 255 && edge_[count] <= light) ++count;
    return count;
  }

 private:
  static constexpr float kParts = 4096;
  std::array<float, 256> light_{};
  std::array<float, 255> edge_{};
  std::array<std::uint8_t, 4096> below_{};  // edges at or below i / kParts
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

// Light of the texels of a level; alpha as it is.
struct Level {
  int width, height;
  std::vector<float> rgba;

  const float* texel(std::size_t at, std::array<float, 4>&) const { return &rgba[4 * at]; }
};

// Level 0 as it is stored: turned into light as it is read, for its floats would be four times the picture.
struct StoredLevel {
  int width, height;
  const std::uint8_t* rgba;
  const Transfer &colour, &linear;

  const float* texel(std::size_t at, std::array<float, 4>& light) const {
    const std::uint8_t* from = rgba + 4 * at;
    light = {colour.light(from[0]), colour.light(from[1]), colour.light(from[2]), linear.light(from[3])};
    return light.data();
  }
};

// The mean of 2x2 texels, in the order in which half_of adds: shares of 1/4 are exact.
template <typename From>
void mean_of_squares(const From& from, Level& to) {
  float* out = to.rgba.data();
  const auto width = static_cast<std::size_t>(from.width);
  std::array<float, 4> texels[4];
  for (std::size_t y = 0; y < static_cast<std::size_t>(to.height); ++y) {
    const std::size_t row = 2 * y * width;
    for (std::size_t at = row; at < row + width; at += 2, out += 4) {
      const float* a = from.texel(at, texels[0]);
      const float* b = from.texel(at + 1, texels[1]);
      const float* c = from.texel(at + width, texels[2]);
      const float* d = from.texel(at + width + 1, texels[3]);
      for (std::size_t channel = 0; channel < 4; ++channel)
        out[channel] = 0.25f * (a[channel] + b[channel] + c[channel] + d[channel]);
    }
  }
}

// The mean of the texels that each new one covers.
template <typename From>
void mean_of_areas(const From& from, bool covers, Level& to) {
  std::vector<Taps> columns;
  for (int x = 0; x < to.width; ++x) columns.push_back(taps_of(x, from.width, to.width));
  float* out = to.rgba.data();
  std::array<float, 4> light;
  for (int y = 0; y < to.height; ++y) {
    const Taps rows = taps_of(y, from.height, to.height);
    for (const Taps& column : columns) {
      std::array<float, 4> sum{}, plain{};
      for (int j = 0; j < rows.count; ++j) {
        for (int i = 0; i < column.count; ++i) {
          const float share =
              rows.share[static_cast<std::size_t>(j)] * column.share[static_cast<std::size_t>(i)];
          const float* texel =
              from.texel(static_cast<std::size_t>(rows.first + j) * static_cast<std::size_t>(from.width) +
                             static_cast<std::size_t>(column.first + i),
                         light);
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
}

template <typename From>
Level half_of(const From& from, bool covers) {
  Level to{std::max(1, from.width / 2), std::max(1, from.height / 2), {}};
  to.rgba.resize(4 * static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height));
  if (!covers && from.width % 2 == 0 && from.height % 2 == 0)
    mean_of_squares(from, to);
  else
    mean_of_areas(from, covers, to);
  return to;
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
    const auto add = [&](const Level& level) {
      record.first_texel[static_cast<std::size_t>(record.levels++)] =
          static_cast<std::int32_t>(built.texels.size());
      append(level, colour, linear, built.texels);
    };
    Level level = half_of(StoredLevel{image.width_px, image.height_px, image.rgba.data(), colour, linear},
                          image.covers);
    add(level);
    while (level.width > 1 || level.height > 1) {
      level = half_of(level, image.covers);
      add(level);
    }
  }
  record.rgba8 = built.texels.data();  // moves along with the vector
  return built;
}

}  // namespace herr
