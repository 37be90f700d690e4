#include "renderer/environment/picture_pyramid.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace herr {
namespace {

// As the kernels look it up: bilinear, columns wrap around, rows end at the poles.
std::array<double, 3> bilinear(const EnvironmentImage& picture, double u, double v) {
  const double x = u * picture.width_px - 0.5, y = v * picture.height_px - 0.5;
  const auto wrapped = [&](double column) {
    const auto at = static_cast<int>(column) % picture.width_px;
    return static_cast<std::size_t>(at < 0 ? at + picture.width_px : at);
  };
  const auto clamped = [&](double row) {
    return static_cast<std::size_t>(std::clamp(row, 0.0, picture.height_px - 1.0));
  };
  const double left = std::floor(x), upper = std::floor(y), tx = x - left, ty = y - upper;
  const std::size_t columns[2] = {wrapped(left), wrapped(left + 1)};
  const std::size_t rows[2] = {clamped(upper), clamped(upper + 1)};
  const double weights[2][2] = {{(1 - tx) * (1 - ty), tx * (1 - ty)}, {(1 - tx) * ty, tx * ty}};
  std::array<double, 3> sum{};
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const float* texel =
          picture.rgba.data() + 4 * (rows[j] * static_cast<std::size_t>(picture.width_px) + columns[i]);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weights[j][i] * double{texel[c]};
    }
  }
  return sum;
}

}  // namespace

glm::dvec3 SkyPicture::direction(double x, double y) const {
  const double azimuth = (x / width - 0.5) * glm::two_pi<double>(), polar = y / height * glm::pi<double>();
  return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

double SkyPicture::solid_angle(int y) const {
  const double step = glm::pi<double>() / height;
  return glm::two_pi<double>() / width * (std::cos(step * y) - std::cos(step * (y + 1)));
}

SkyPicture resampled(const EnvironmentImage& picture, int width, const ParallelFor& parallel) {
  SkyPicture out{width, width / 2, {}};
  out.texels.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  if (picture.width_px == out.width && picture.height_px == out.height) {
    for (std::size_t i = 0; i < out.texels.size(); ++i) {
      std::copy_n(picture.rgba.data() + 4 * i, 3, out.texels[i].data());
      out.texels[i][3] = 0;
    }
    return out;
  }
  const int steps = std::max(2, 2 * ((picture.width_px + width - 1) / width));
  parallel(out.height, [&](int y) {
    for (int x = 0; x < out.width; ++x) {
      std::array<double, 3> sum{};
      double weights = 0;
      for (int j = 0; j < steps; ++j) {
        const double v = (y + (j + 0.5) / steps) / out.height, weight = std::sin(v * glm::pi<double>());
        for (int i = 0; i < steps; ++i) {
          const std::array<double, 3> sample = bilinear(picture, (x + (i + 0.5) / steps) / out.width, v);
          for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * sample[c];
          weights += weight;
        }
      }
      std::array<float, 4>& texel = out.texels[static_cast<std::size_t>(y * out.width + x)];
      for (std::size_t c = 0; c < 3; ++c) texel[c] = static_cast<float>(sum[c] / weights);
    }
  });
  return out;
}

SkyPicture halved(const SkyPicture& picture) {
  SkyPicture out{picture.width / 2, picture.height / 2, {}};
  out.texels.reserve(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  for (int y = 0; y < out.height; ++y) {
    const double upper = picture.solid_angle(2 * y), lower = picture.solid_angle(2 * y + 1);
    const auto share = static_cast<float>(0.5 * upper / (upper + lower)), rest = 0.5f - share;
    for (int x = 0; x < out.width; ++x) {
      std::array<float, 4> texel{};
      for (std::size_t c = 0; c < 3; ++c) {
        texel[c] = share * (picture.at(2 * x, 2 * y)[c] + picture.at(2 * x + 1, 2 * y)[c]) +
                   rest * (picture.at(2 * x, 2 * y + 1)[c] + picture.at(2 * x + 1, 2 * y + 1)[c]);
      }
      out.texels.push_back(texel);
    }
  }
  return out;
}

namespace {

// Each texel of a row: the mean over as many of its neighbours as lie side by side within its height.
void round_off_poles(SkyPicture& picture) {
  std::vector<std::array<double, 3>> sums(static_cast<std::size_t>(picture.width) + 1);
  for (int y = 0; y < picture.height; ++y) {
    const double sine = std::sin((y + 0.5) / picture.height * glm::pi<double>());
    const int reach = std::min(static_cast<int>(std::lround(0.5 / sine - 0.5)), (picture.width - 1) / 2);
    if (reach < 1) continue;
    std::array<float, 4>* row =
        picture.texels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width);
    for (int x = 0; x < picture.width; ++x) {
      const auto at = static_cast<std::size_t>(x);
      for (std::size_t c = 0; c < 3; ++c) sums[at + 1][c] = sums[at][c] + double{row[x][c]};
    }
    const auto before = [&](int x, std::size_t c) {  // sum up to x, round the circle
      const int turns = x < 0 ? -1 : x / picture.width;
      return turns * sums.back()[c] + sums[static_cast<std::size_t>(x - turns * picture.width)][c];
    };
    for (int x = 0; x < picture.width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        row[x][c] = static_cast<float>((before(x + reach + 1, c) - before(x - reach, c)) / (2 * reach + 1));
      }
    }
  }
}

}  // namespace

std::vector<SkyPicture> pyramid_of(SkyPicture picture) {
  std::vector<SkyPicture> levels;
  levels.push_back(std::move(picture));
  while (levels.back().width > 4) levels.push_back(halved(levels.back()));
  for (SkyPicture& level : levels) round_off_poles(level);
  return levels;
}

}  // namespace herr
