#include "tests/renderer/reflectance/slow_sky.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace herr::test {
namespace {

constexpr double kPi = glm::pi<double>();
constexpr double kBrightTimesMean = 8;

glm::dvec2 place_of(const glm::dvec3& d) {
  return {std::atan2(d.x, -d.z) / (2 * kPi) + 0.5, std::acos(std::clamp(d.y, -1.0, 1.0)) / kPi};
}

glm::dvec3 direction_of(double u, double v) {
  const double azimuth = 2 * kPi * (u - 0.5), polar = kPi * v;
  return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

double solid_angle_of(double du, double upper, double lower) {
  return 2 * kPi * du * (std::cos(kPi * upper) - std::cos(kPi * lower));
}

}  // namespace

PictureDirections::PictureDirections(EnvironmentImage picture_in) : picture_(std::move(picture_in)) {
  const EnvironmentImage& picture = picture_;
  const int width = picture.width_px, height = picture.height_px;
  double all = 0;
  for (int y = 0; y < height; ++y) {
    const double solid_angle =
        2 * kPi / width * (std::cos(kPi * y / height) - std::cos(kPi * (y + 1) / height));
    double row = 0;
    for (int x = 0; x < width; ++x) {
      // Of the neighbours too: bilinear look-ups carry their light here.
      double bright = 1e-6;
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const int column = (x + i + width) % width, line = std::clamp(y + j, 0, height - 1);
          const float* texel =
              picture.rgba.data() + 4 * (static_cast<std::size_t>(line) * static_cast<std::size_t>(width) +
                                         static_cast<std::size_t>(column));
          bright = std::max(bright, double{texel[0]} + double{texel[1]} + double{texel[2]});
        }
      }
      columns_.push_back(row += bright * solid_angle);
      densities_.push_back(bright);
    }
    for (int x = 0; x < width; ++x) columns_[columns_.size() - 1 - static_cast<std::size_t>(x)] /= row;
    rows_.push_back(all += row);
  }
  for (double& row : rows_) row /= all;
  for (double& density : densities_) density /= all;
}

glm::dvec3 PictureDirections::draw(const glm::dvec2& random) const {
  const auto inside = [](auto begin, auto end, double u, double& rest) {
    const auto at = std::min(std::upper_bound(begin, end, u), end - 1);
    const double below = at == begin ? 0 : *(at - 1);
    rest = (u - below) / (*at - below);
    return at - begin;
  };
  double in_row = 0, in_column = 0;
  const auto y = inside(rows_.begin(), rows_.end(), random.y, in_row);
  const auto first = columns_.begin() + y * picture_.width_px;
  const auto x = inside(first, first + picture_.width_px, random.x, in_column);
  const double upper = std::cos(kPi * static_cast<double>(y) / picture_.height_px),
               lower = std::cos(kPi * static_cast<double>(y + 1) / picture_.height_px);
  const double cosine = upper + (lower - upper) * in_row,
               sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const double azimuth = 2 * kPi * ((static_cast<double>(x) + in_column) / picture_.width_px - 0.5);
  return {sine * std::sin(azimuth), cosine, -sine * std::cos(azimuth)};
}

double PictureDirections::density(const glm::dvec3& direction) const {
  const glm::dvec2 at = place_of(direction);
  const int x = std::clamp(static_cast<int>(at.x * picture_.width_px), 0, picture_.width_px - 1),
            y = std::clamp(static_cast<int>(at.y * picture_.height_px), 0, picture_.height_px - 1);
  return densities_[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width_px) +
                    static_cast<std::size_t>(x)];
}

glm::dvec3 PictureDirections::radiance(const glm::dvec3& direction) const {
  const glm::dvec2 at = place_of(direction);
  const int width = picture_.width_px, height = picture_.height_px;
  const double x = at.x * width - 0.5, y = at.y * height - 0.5, left = std::floor(x), upper = std::floor(y);
  glm::dvec3 sum{0.0};
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const int column = (static_cast<int>(left) + i + width) % width,
                row = std::clamp(static_cast<int>(upper) + j, 0, height - 1);
      const double weight = (i == 0 ? 1 - (x - left) : x - left) * (j == 0 ? 1 - (y - upper) : y - upper);
      const float* texel =
          picture_.rgba.data() + 4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                      static_cast<std::size_t>(column));
      sum += weight * glm::dvec3{texel[0], texel[1], texel[2]};
    }
  }
  return sum;
}

SlowSky::SlowSky(const EnvironmentImage& picture)
    : whole(picture),
      rest(take_bright(picture, bright)),
      texel_rad(kPi / picture.height_px),
      width_(picture.width_px),
      height_(picture.height_px) {
  std::vector<Point> points;
  for (BrightTexel& texel : bright) {
    points_of(texel, 8, points);
    for (const Point& point : points) texel.solid_angle += point.solid_angle;
  }
}

EnvironmentImage SlowSky::take_bright(const EnvironmentImage& picture, std::vector<BrightTexel>& bright) {
  EnvironmentImage rest = picture;
  const int width = picture.width_px, height = picture.height_px;
  const auto brightness = [](const float* texel) {
    return (double{texel[0]} + double{texel[1]} + double{texel[2]}) / 3;
  };
  float* const first = rest.rgba.data();
  const auto texel_at = [&](int x, int y) {
    return first +
           4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  };
  double mean = 0;
  for (int y = 0; y < height; ++y) {
    const double each = solid_angle_of(1.0 / width, 1.0 * y / height, (y + 1.0) / height) / (4 * kPi);
    for (int x = 0; x < width; ++x) mean += each * brightness(texel_at(x, y));
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      float* texel = texel_at(x, y);
      const double bright_here = brightness(texel), most = kBrightTimesMean * mean;
      if (bright_here <= most) continue;
      const glm::dvec3 before{texel[0], texel[1], texel[2]};
      for (int c = 0; c < 3; ++c) texel[c] = static_cast<float>(before[c] * most / bright_here);
      BrightTexel out;
      out.column = x;
      out.row = y;
      out.direction = direction_of((x + 0.5) / width, (y + 0.5) / height);
      out.radiance = before - glm::dvec3{texel[0], texel[1], texel[2]};
      bright.push_back(out);
    }
  }
  return rest;
}

void SlowSky::points_of(const BrightTexel& texel, int steps, std::vector<Point>& points) const {
  points.clear();
  const double step = 2.0 / steps;
  for (int j = 0; j < steps; ++j) {
    const double dy = -1 + step * (j + 0.5), y = texel.row + 0.5 + dy;
    if (y < 0 || y > height_) continue;
    // Rows end at the poles: beyond the middle of the first and last one their texel is seen whole.
    const bool at_pole = y < 0.5 || y > height_ - 0.5;
    const double down = at_pole ? 1 : 1 - std::abs(dy);
    const double each = solid_angle_of(step / width_, (y - 0.5 * step) / height_, (y + 0.5 * step) / height_);
    for (int i = 0; i < steps; ++i) {
      const double dx = -1 + step * (i + 0.5);
      points.push_back(
          {direction_of((texel.column + 0.5 + dx) / width_, y / height_), each * down * (1 - std::abs(dx))});
    }
  }
}

}  // namespace herr::test
