#include "renderer/geometry/texture_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

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
    edge_[255] = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < below_.size(); ++i) {
      const float light = static_cast<float>(i) / kParts;
      below_[i] =
          static_cast<std::uint8_t>(std::upper_bound(edge_.begin(), edge_.end(), light) - edge_.begin());
    }
  }
  float light(std::uint8_t value) const { return light_[value]; }
  // As many as there are edges at or below the light: those at or below the start of its part of [0, 1], and
  // at most one in it, for edges lie farther apart (3.0e-4 at the dark end of sRGB) than a part is long
  // (2.4e-4).
  std::uint8_t value(float light) const {
    const std::uint8_t count = below_[static_cast<std::size_t>(light * kParts)];
    return static_cast<std::uint8_t>(count + (edge_[count] <= light ? 1 : 0));
  }

 private:
  static constexpr float kParts = 4096;
  std::array<float, 256> light_{}, edge_{};
  std::array<std::uint8_t, 4098> below_{};  // sums of shares may end a hair above 1
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

std::uint32_t texel_of(const float* light, const Transfer& colour, const Transfer& linear) {
  const std::uint8_t texel[4] = {colour.value(light[0]), colour.value(light[1]), colour.value(light[2]),
                                 linear.value(light[3])};
  std::uint32_t word;
  std::memcpy(&word, texel, sizeof word);
  return word;
}

// Levels below a stored picture, all in one pass over it: two rows of a level make one of the next at once,
// while both sides are even; from the first odd side on, level by level.
class LevelBuilder {
 public:
  LevelBuilder(const TextureImage& image, TextureLevels& built)
      : image_(image), built_(built), colour_(image.srgb), linear_(false) {}

  void build() {
    add_places();
    const StoredLevel stored{image_.width_px, image_.height_px, image_.rgba.data(), colour_, linear_};
    if (streams(0)) {
      rows_.resize(built_.record.levels);
      for (int y = 0; y < image_.height_px; y += 2) halve_rows(stored, y);
      level_by_level(std::move(rest_));
    } else {
      store_whole(1, half_of(stored));
    }
  }

 private:
  int width(int level) const { return std::max(1, image_.width_px >> level); }
  int height(int level) const { return std::max(1, image_.height_px >> level); }
  bool streams(int level) const { return !image_.covers && width(level) % 2 == 0 && height(level) % 2 == 0; }
  std::uint32_t* texels_of(int level) const {
    return built_.texels.data() + built_.record.first_texel[static_cast<std::size_t>(level)];
  }

  // Where each level lies.
  void add_places() {
    TextureRecord& record = built_.record;
    std::size_t end = built_.texels.size();
    for (int level = 1; width(level - 1) > 1 || height(level - 1) > 1; ++level) {
      record.first_texel[static_cast<std::size_t>(record.levels++)] = static_cast<std::int32_t>(end);
      end += static_cast<std::size_t>(width(level)) * static_cast<std::size_t>(height(level));
    }
    built_.texels.resize(end);
  }

  Level half_of(const auto& from) const {
    Level to{std::max(1, from.width / 2), std::max(1, from.height / 2), {}};
    to.rgba.resize(4 * static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height));
    mean_of_areas(from, image_.covers, to);
    return to;
  }

  // Stores `light` as that level, then all after it.
  void store_whole(int level, Level light) {
    std::uint32_t* out = texels_of(level);
    for (std::size_t i = 0; i < light.rgba.size(); i += 4)
      *out++ = texel_of(&light.rgba[i], colour_, linear_);
    level_by_level(std::move(light), level);
  }
  void level_by_level(Level light, int level) {
    if (light.width > 1 || light.height > 1) store_whole(level + 1, half_of(light));
  }
  void level_by_level(Level rest) {
    if (!rest.rgba.empty()) level_by_level(std::move(rest), rest_level_);
  }

  // Rows y and y + 1 of the stored picture.
  void halve_rows(const StoredLevel& from, int y) {
    std::vector<float>& row = row_of(1);
    const auto w = static_cast<std::size_t>(from.width);
    const std::size_t first = static_cast<std::size_t>(y) * w;
    std::array<float, 4> texels[4];
    float* out = row.data();
    for (std::size_t at = first; at < first + w; at += 2, out += 4) {
      mean_of_four(from.texel(at, texels[0]), from.texel(at + 1, texels[1]), from.texel(at + w, texels[2]),
                   from.texel(at + w + 1, texels[3]), out);
    }
    take_row(1, y / 2);
  }

  // The mean as mean_of_areas adds it up: shares of 1/4 are exact.
  static void mean_of_four(const float* a, const float* b, const float* c, const float* d, float* out) {
    for (std::size_t channel = 0; channel < 4; ++channel)
      out[channel] = 0.25f * (a[channel] + b[channel] + c[channel] + d[channel]);
  }

  // Room for two rows of a level: the one at hand.
  std::vector<float>& row_of(int level) {
    Rows& rows = rows_[static_cast<std::size_t>(level)];
    std::vector<float>& row = rows.row[rows.taken % 2];
    row.resize(4 * static_cast<std::size_t>(width(level)));
    return row;
  }

  // Row y of a level is in row_of(level): stores it, and makes a row of the next level of every two.
  void take_row(int level, int y) {
    const auto index = static_cast<std::size_t>(level);
    const auto w = static_cast<std::size_t>(width(level));
    const std::vector<float>& row = rows_[index].row[rows_[index].taken % 2];
    std::uint32_t* out = texels_of(level) + static_cast<std::size_t>(y) * w;
    for (std::size_t x = 0; x < w; ++x) out[x] = texel_of(&row[4 * x], colour_, linear_);
    if (!streams(level)) {
      keep_row(level, row);
      return;
    }
    if (++rows_[index].taken % 2 != 0) return;
    std::vector<float>& next = row_of(level + 1);
    const std::vector<float>&upper = rows_[index].row[0], &lower = rows_[index].row[1];
    for (std::size_t x = 0; x < w; x += 2)
      mean_of_four(&upper[4 * x], &upper[4 * x + 4], &lower[4 * x], &lower[4 * x + 4], &next[2 * x]);
    take_row(level + 1, y / 2);
  }

  // Of the level that is halved as a whole.
  void keep_row(int level, const std::vector<float>& row) {
    rest_level_ = level;
    rest_.width = width(level);
    rest_.height = height(level);
    rest_.rgba.insert(rest_.rgba.end(), row.begin(), row.end());
  }

  struct Rows {
    std::array<std::vector<float>, 2> row;
    std::size_t taken = 0;
  };

  const TextureImage& image_;
  TextureLevels& built_;
  const Transfer colour_, linear_;
  std::vector<Rows> rows_;  // by level
  Level rest_{};
  int rest_level_ = 0;
};

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
  if (image.width_px > 1 || image.height_px > 1) LevelBuilder(image, built).build();
  record.rgba8 = built.texels.data();  // moves along with the vector
  return built;
}

}  // namespace herr
