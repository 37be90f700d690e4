#include "renderer/environment/filtered_environment.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "renderer/environment/blurred_picture.h"
#include "renderer/environment/bright_sources.h"

namespace herr {
namespace {

// Of roughness 0.05: half a texel of the finest level wide. Towards roughness 0 the picture itself is shown.
constexpr float kFirstAlpha = 0.0025f;
// Lobes of this many texels, as half vectors turn, smooth out the parts of a wide source: its lattice of
// discs, each of a texel's light, shows by 1 % at most.
constexpr float kSmoothTexels = 0.35f;
constexpr int kWidestPicture = 1024, kWidestLevel = 1024, kNarrowestLevel = 32;
// Texels of a level along what its lobe turns directions by; interpolation shows no corners.
constexpr double kTexelsPerAlpha = 1.0 / 0.7;

double alpha_of(int level) {
  return kFirstAlpha * std::pow(1.0 / kFirstAlpha, level / (kMostFilteredLevels - 1.0));
}

// Interpolation between texels widens what it shows by a quarter of a texel, as half vectors turn, along each
// axis: the lobe is made that much narrower, and half as wide at least.
double made_alpha(int level, int width) {
  const double alpha2 = alpha_of(level) * alpha_of(level), texel = glm::two_pi<double>() / width;
  return std::sqrt(std::max(alpha2 - 2 * (0.25 * texel) * (0.25 * texel), 0.25 * alpha2));
}

int power_of_two(double at_least, int least, int most) {
  int width = least;
  while (width < most && width < at_least) width *= 2;
  return width;
}

// Light that each direction's surface receives, over pi.
SkyPicture evenly_lit(const SkyPicture& picture) {
  SkyPicture out{32, 16, {}};
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const glm::dvec3 n = out.direction(x + 0.5, y + 0.5);
      double sum[3] = {}, cosines = 0;
      for (int j = 0; j < picture.height; ++j) {
        for (int i = 0; i < picture.width; ++i) {
          const double cosine = glm::dot(n, picture.direction(i + 0.5, j + 0.5)) * picture.solid_angle(j);
          if (cosine <= 0) continue;
          cosines += cosine;
          for (std::size_t c = 0; c < 3; ++c) sum[c] += cosine * double{picture.at(i, j)[c]};
        }
      }
      std::array<float, 4> texel{};
      for (std::size_t c = 0; c < 3; ++c) texel[c] = static_cast<float>(sum[c] / cosines);
      out.texels.push_back(texel);
    }
  }
  return out;
}

glm::dvec3 evenly_lit_by(const std::vector<BrightDisc>& discs, const glm::dvec3& n) {
  glm::dvec3 sum{0.0};
  for (const BrightDisc& disc : discs) {
    const double cosine = glm::dot(n, {disc.direction[0], disc.direction[1], disc.direction[2]});
    if (cosine <= 0) continue;
    sum += cosine * glm::one_over_pi<double>() *
           glm::dvec3{disc.irradiance[0], disc.irradiance[1], disc.irradiance[2]};
  }
  return sum;
}

// Bilinear, in a direction of the world.
std::array<float, 4> seen_in(const SkyPicture& picture, const glm::dvec3& d, float turn) {
  const double column = std::atan2(d.x, -d.z) / glm::two_pi<double>() + 0.5 + double{turn};
  const double x = (column - std::floor(column)) * picture.width - 0.5,
               y = std::atan2(std::hypot(d.x, d.z), d.y) / glm::pi<double>() * picture.height - 0.5;
  const auto left = static_cast<int>(std::floor(x)), upper = static_cast<int>(std::floor(y));
  const auto tx = static_cast<float>(x - left), ty = static_cast<float>(y - upper);
  const int mask = picture.width - 1, last = picture.height - 1;
  std::array<float, 4> sum{};
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const float weight = (i == 0 ? 1 - tx : tx) * (j == 0 ? 1 - ty : ty);
      const std::array<float, 4>& texel = picture.at((left + i) & mask, std::clamp(upper + j, 0, last));
      for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * texel[c];
    }
  }
  return sum;
}

glm::dvec3 turned_back(const glm::dvec3& d, float turn) {
  const double angle = double{turn} * glm::two_pi<double>(), c = std::cos(angle), s = std::sin(angle);
  return {c * d.x - s * d.z, d.y, s * d.x + c * d.z};
}

const SkyPicture& of_width(const std::vector<SkyPicture>& pyramid, int width) {
  for (const SkyPicture& picture : pyramid) {
    if (picture.width <= width) return picture;
  }
  return pyramid.back();
}

EnvironmentRecord as_record(const SkyPicture& picture, float turn) {
  if (picture.texels.empty()) return {};
  return {picture.texels.front().data(), picture.width, picture.height, turn};
}

}  // namespace

FilteredEnvironment::FilteredEnvironment(const EnvironmentImage& picture, int probe_rays,
                                         const ParallelFor& parallel) {
  const int width = power_of_two(picture.width_px, 64, kWidestPicture);
  SkyPicture dimmed = resampled(picture, width, parallel);
  const std::vector<SkyPicture> whole = pyramid_of(dimmed);
  BrightLight bright = take_bright_sources(dimmed);
  parts_ = std::move(bright.parts);
  without_small_ = std::move(bright.without_small);
  record_.small_sources = bright.small;
  record_.source_count = static_cast<int>(bright.sources.size());
  std::copy(bright.sources.begin(), bright.sources.end(), record_.sources);
  record_.levels = kMostFilteredLevels;
  record_.first_alpha = kFirstAlpha;
  // The mirrored ray turns by twice what half vectors do.
  const auto texel_rad = static_cast<float>(glm::two_pi<double>() / width);
  record_.smooth_alpha =
      bright.small < record_.source_count ? std::max(kFirstAlpha, kSmoothTexels * texel_rad) : kFirstAlpha;
  record_.levels_per_octave = static_cast<float>((kMostFilteredLevels - 1) / std::log2(1.0 / kFirstAlpha));
  const std::vector<SkyPicture> rest = pyramid_of(std::move(dimmed));
  filter_levels(rest, parallel);
  even_rest_ = evenly_lit(of_width(rest, 64));
  even_ = even_rest_;
  for (int y = 0; y < even_.height; ++y) {
    for (int x = 0; x < even_.width; ++x) {
      const glm::dvec3 more = evenly_lit_by(parts_, even_.direction(x + 0.5, y + 0.5));
      std::array<float, 4>& texel = even_.texels[static_cast<std::size_t>(y * even_.width + x)];
      for (int c = 0; c < 3; ++c) texel[static_cast<std::size_t>(c)] += static_cast<float>(more[c]);
    }
  }
  if (probe_rays <= 0) return;
  // As many texels as rays, or up to four times: rays that leave no gaps between them.
  const double spacing = std::sqrt(4 * glm::pi<double>() / probe_rays);
  const int rays_around = power_of_two(glm::two_pi<double>() / spacing, 4, width);
  coarse_ = of_width(whole, rays_around);
  coarse_rest_ = of_width(rest, rays_around);
  for (std::size_t i = 0; i < coarse_.texels.size(); ++i) {
    const std::array<float, 4>& all = coarse_.texels[i];
    std::array<float, 4>& left = coarse_rest_.texels[i];
    left[3] = std::max((all[0] + all[1] + all[2] - left[0] - left[1] - left[2]) / 3, 0.0f);
  }
}

void FilteredEnvironment::filter_levels(const std::vector<SkyPicture>& from, const ParallelFor& parallel) {
  for (int k = 0, texels = 0; k < record_.levels; ++k) {
    const double wanted = glm::two_pi<double>() * kTexelsPerAlpha / alpha_of(k);
    record_.width[k] = power_of_two(wanted, kNarrowestLevel, std::min(kWidestLevel, from.front().width));
    record_.height[k] = record_.width[k] / 2;
    record_.first_texel[k] = texels;
    texels += record_.width[k] * record_.height[k];
    texels_.resize(4 * static_cast<std::size_t>(texels));
  }
  for (int k = 0; k < record_.levels; ++k) {
    const SkyPicture level = blurred(from, made_alpha(k, record_.width[k]), record_.width[k], parallel);
    float* texel = texels_.data() + 4 * static_cast<std::size_t>(record_.first_texel[k]);
    for (const std::array<float, 4>& of : level.texels) texel = std::copy(of.begin(), of.end(), texel);
  }
}

FilteredRecord FilteredEnvironment::record(float turn) const {
  FilteredRecord out = record_;
  out.texels = texels_.data();
  out.without_small = as_record(without_small_, turn);
  out.even = as_record(even_, turn);
  out.coarse = as_record(coarse_, turn);
  out.parts = parts_.data();
  const double angle = double{turn} * glm::two_pi<double>(), c = std::cos(angle), s = std::sin(angle);
  out.turn_cosine = static_cast<float>(c);
  out.turn_sine = static_cast<float>(s);
  for (int i = 0; i < out.source_count; ++i) {
    const float* of = record_.sources[i].direction;
    const double x = of[0], z = of[2];
    // Counter-clockwise as seen from above: -Z turns towards -X.
    out.sources[i].direction[0] = static_cast<float>(c * x + s * z);
    out.sources[i].direction[2] = static_cast<float>(c * z - s * x);
  }
  return out;
}

glm::dvec4 FilteredEnvironment::seen_by_rays(const glm::dvec3& direction, float turn) const {
  const std::array<float, 4> seen = seen_in(coarse_rest_, direction, turn);
  return {seen[0], seen[1], seen[2], seen[3]};
}

glm::dvec3 FilteredEnvironment::even_rest(const glm::dvec3& normal, float turn) const {
  const std::array<float, 4> lit = seen_in(even_rest_, normal, turn);
  return {lit[0], lit[1], lit[2]};
}

glm::dvec3 FilteredEnvironment::even_sources(const glm::dvec3& normal, float turn) const {
  return evenly_lit_by(parts_, turned_back(normal, turn));
}

std::int64_t FilteredEnvironment::bytes() const {
  const std::size_t floats = texels_.size() + 4 * without_small_.texels.size() + 8 * even_.texels.size() +
                             4 * (coarse_.texels.size() + coarse_rest_.texels.size());
  return static_cast<std::int64_t>(sizeof(float) * floats + sizeof(BrightDisc) * parts_.size());
}

}  // namespace herr
