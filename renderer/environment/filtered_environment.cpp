#include "renderer/environment/filtered_environment.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "renderer/environment/bright_sources.h"

namespace herr {
namespace {

// Of roughness 0.05: half a texel of the finest level wide. Towards roughness 0 the picture itself is shown.
constexpr float kFirstAlpha = 0.0025f;
constexpr int kWidestPicture = 1024, kWidestLevel = 512, kNarrowestLevel = 32;
// Texels of a level along what its lobe turns directions by; interpolation shows no corners.
constexpr double kTexelsPerAlpha = 1.0 / 0.7;
// Sources stand apart in lobes whose alpha is at least this times the half turn to their rim: they are then
// shown as an equal disc would be to a hundredth of the lobe's height.
constexpr float kAlphasOfSource = 2.0f;

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

// Where a texel of a level looks in the pyramid: so many columns on, at a height; rows of a level share it.
struct Tap {
  double columns = 0;  // of the whole turn, [0, 1)
  double height = 0;   // [0, 1] from the zenith
  int level = 0;
  float finer = 1, weight = 0;
};

// Rings around the mirrored direction, wider outwards, on which the lobe hardly changes.
struct Ring {
  double middle, solid_angle, weight;
  int places;
};

// GGX seen head on, n = v = r, over the directions: D / 4, weighed by the other half of Smith's masking.
double lobe(double off, double alpha2) {
  const double half = std::cos(0.5 * off), cosine = std::cos(off);
  const double bottom = half * half * (alpha2 - 1) + 1;
  const double masked = 2 * cosine / (cosine + std::sqrt(alpha2 + (1 - alpha2) * cosine * cosine));
  return alpha2 / (bottom * bottom) * masked;
}

std::vector<Ring> rings_of(double alpha) {
  constexpr double kWider = 1.45;
  std::vector<Ring> rings;
  double inner = 0, outer = 0.5 * alpha;
  while (inner < glm::half_pi<double>()) {
    outer = std::min(outer, glm::half_pi<double>());
    const double centre = 0.5 * (inner + outer), a2 = alpha * alpha;
    const double mean = (lobe(inner, a2) + 4 * lobe(centre, a2) + lobe(outer, a2)) / 6;
    const double solid_angle = glm::two_pi<double>() * (std::cos(inner) - std::cos(outer));
    rings.push_back(
        {inner == 0 ? outer * 0.7071 : centre, solid_angle, mean * solid_angle, inner == 0 ? 6 : 12});
    inner = outer;
    outer *= kWider;
  }
  return rings;
}

struct Frame {
  glm::dvec3 right, up, ahead;
};
Frame frame_of(const glm::dvec3& ahead) {
  const glm::dvec3 side = std::abs(ahead.y) < 0.9 ? glm::dvec3{0, 1, 0} : glm::dvec3{1, 0, 0};
  const glm::dvec3 right = glm::normalize(glm::cross(side, ahead));
  return {right, glm::cross(ahead, right), ahead};
}

// The taps of the row of texels at `height`, for the one at azimuth 0.
std::vector<Tap> taps_of(double height, const std::vector<Ring>& rings, int pyramid_levels, int full_width) {
  const double polar = height * glm::pi<double>();
  const Frame frame = frame_of({0, std::cos(polar), -std::sin(polar)});
  double all = 0;
  for (const Ring& ring : rings) all += ring.weight;
  std::vector<Tap> taps;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const Ring& ring = rings[r];
    for (int place = 0; place < ring.places; ++place) {
      const double turn = glm::two_pi<double>() * (place + 0.5 * static_cast<double>(r % 2)) / ring.places;
      const glm::dvec3 d = frame.ahead * std::cos(ring.middle) +
                           (frame.right * std::cos(turn) + frame.up * std::sin(turn)) * std::sin(ring.middle);
      Tap tap;
      const double column = std::atan2(d.x, -d.z) / glm::two_pi<double>();
      tap.columns = column - std::floor(column);
      tap.height = std::atan2(std::hypot(d.x, d.z), d.y) / glm::pi<double>();
      tap.weight = static_cast<float>(ring.weight / all / ring.places);
      // Texels as large as what the tap stands for; square at the equator, and lower than wide nowhere.
      const double side = std::sqrt(ring.solid_angle / ring.places);
      const double level =
          std::clamp(std::log2(side * full_width / glm::two_pi<double>()), 0.0, pyramid_levels - 1.0);
      tap.level = std::min(static_cast<int>(level), pyramid_levels - 2);
      tap.finer = static_cast<float>(1 - (level - tap.level));
      taps.push_back(tap);
    }
  }
  return taps;
}

void add(const SkyPicture& picture, double column, double height, float weight, std::array<float, 4>& sum) {
  const double x = column * picture.width - 0.5, y = height * picture.height - 0.5;
  const auto left = static_cast<int>(std::floor(x)), upper = static_cast<int>(std::floor(y));
  const auto tx = static_cast<float>(x - left), ty = static_cast<float>(y - upper);
  const int mask = picture.width - 1, last = picture.height - 1;  // the width is a power of two
  const int x0 = left & mask, x1 = (left + 1) & mask;
  const int y0 = std::clamp(upper, 0, last), y1 = std::clamp(upper + 1, 0, last);
  const auto &a = picture.at(x0, y0), &b = picture.at(x1, y0), &c = picture.at(x0, y1),
             &d = picture.at(x1, y1);
  const float wa = weight * (1 - tx) * (1 - ty), wb = weight * tx * (1 - ty), wc = weight * (1 - tx) * ty,
              wd = weight * tx * ty;
  for (std::size_t i = 0; i < 4; ++i) sum[i] += wa * a[i] + wb * b[i] + wc * c[i] + wd * d[i];
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
  std::vector<SkyPicture> whole = pyramid_of(resampled(picture, width, parallel));
  SkyPicture dimmed = whole.front();
  const std::vector<BrightSource> sources = take_bright_sources(dimmed);
  record_.source_count = static_cast<int>(sources.size());
  std::copy(sources.begin(), sources.end(), record_.sources);
  float widest = 0;
  for (const BrightSource& source : sources) widest = std::max(widest, std::sqrt(source.half_turn2));
  record_.levels = kMostFilteredLevels;
  record_.first_alpha = kFirstAlpha;
  record_.levels_per_octave = static_cast<float>((kMostFilteredLevels - 1) / std::log2(1.0 / kFirstAlpha));
  // The finest level, towards which sharper lobes fade from the picture itself, has the sources always.
  record_.first_without_sources = 1;
  while (record_.first_without_sources < kMostFilteredLevels &&
         alpha_of(record_.first_without_sources) < double{kAlphasOfSource * widest}) {
    ++record_.first_without_sources;
  }
  if (sources.empty()) record_.first_without_sources = kMostFilteredLevels;
  filter_levels(whole, pyramid_of(std::move(dimmed)), parallel);
  even_ = evenly_lit(of_width(whole, 64));
  if (probe_rays <= 0) return;
  // As many texels as rays, or up to four times: rays that leave no gaps between them.
  const double spacing = std::sqrt(4 * glm::pi<double>() / probe_rays);
  coarse_ = of_width(whole, power_of_two(glm::two_pi<double>() / spacing, 4, width));
}

void FilteredEnvironment::filter_levels(const std::vector<SkyPicture>& whole,
                                        const std::vector<SkyPicture>& rest, const ParallelFor& parallel) {
  int texels = 0;
  std::vector<int> first_row{0};
  for (int k = 0; k < record_.levels; ++k) {
    const double wanted = glm::two_pi<double>() * kTexelsPerAlpha / alpha_of(k);
    record_.width[k] = power_of_two(wanted, kNarrowestLevel, std::min(kWidestLevel, whole.front().width));
    record_.height[k] = record_.width[k] / 2;
    record_.first_texel[k] = texels;
    texels += record_.width[k] * record_.height[k];
    first_row.push_back(first_row.back() + record_.height[k]);
  }
  texels_.resize(4 * static_cast<std::size_t>(texels));
  parallel(first_row.back(), [&](int row) {
    const auto k =
        static_cast<int>(std::upper_bound(first_row.begin(), first_row.end(), row) - first_row.begin() - 1);
    const auto level = static_cast<std::size_t>(k);
    const std::vector<SkyPicture>& from = k < record_.first_without_sources ? whole : rest;
    const int width = record_.width[level], y = row - first_row[level];
    const std::vector<Tap> taps = taps_of((y + 0.5) / record_.height[level], rings_of(made_alpha(k, width)),
                                          static_cast<int>(from.size()), from.front().width);
    for (int x = 0; x < width; ++x) {
      std::array<float, 4> sum{};
      for (const Tap& tap : taps) {
        const double column = tap.columns + (x + 0.5) / width;
        const auto finer = static_cast<std::size_t>(tap.level);
        add(from[finer], column, tap.height, tap.weight * tap.finer, sum);
        add(from[finer + 1], column, tap.height, tap.weight * (1 - tap.finer), sum);
      }
      float* texel =
          texels_.data() + 4 * static_cast<std::size_t>(record_.first_texel[level] + y * width + x);
      std::copy(sum.begin(), sum.end(), texel);
    }
  });
}

FilteredRecord FilteredEnvironment::record(float turn) const {
  FilteredRecord out = record_;
  out.texels = texels_.data();
  out.even = as_record(even_, turn);
  out.coarse = as_record(coarse_, turn);
  const double angle = double{turn} * glm::two_pi<double>(), c = std::cos(angle), s = std::sin(angle);
  for (int i = 0; i < out.source_count; ++i) {
    const float* of = record_.sources[i].direction;
    const double x = of[0], z = of[2];
    // Counter-clockwise as seen from above: -Z turns towards -X.
    out.sources[i].direction[0] = static_cast<float>(c * x + s * z);
    out.sources[i].direction[2] = static_cast<float>(c * z - s * x);
  }
  return out;
}

std::int64_t FilteredEnvironment::bytes() const {
  const std::size_t floats = texels_.size() + 4 * (even_.texels.size() + coarse_.texels.size());
  return static_cast<std::int64_t>(sizeof(float) * floats);
}

}  // namespace herr
