#include "renderer/environment/blurred_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace herr {
namespace {

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

// The lobe over all directions of a ring: Simpson's rule on eight parts of it.
double mean_of_lobe(double inner, double outer, double alpha2) {
  constexpr int kParts = 8;
  double sum = 0, weights = 0;
  for (int i = 0; i <= 2 * kParts; ++i) {
    const double off = inner + (outer - inner) * i / (2 * kParts);
    const double weight = (i == 0 || i == 2 * kParts ? 1 : i % 2 == 1 ? 4 : 2) * std::sin(off);
    sum += weight * lobe(off, alpha2);
    weights += weight;
  }
  return sum / weights;
}

// Their weights sum to 1. Within most of a texel nothing changes.
std::vector<Ring> rings_of(double alpha, double texel) {
  constexpr double kWider = 1.45;
  std::vector<Ring> rings;
  double inner = 0, outer = std::max(0.5 * alpha, 0.7 * texel), all = 0;
  while (inner < glm::half_pi<double>()) {
    outer = std::min(outer, glm::half_pi<double>());
    const double solid_angle = glm::two_pi<double>() * (std::cos(inner) - std::cos(outer));
    const double weight = mean_of_lobe(inner, outer, alpha * alpha) * solid_angle;
    rings.push_back(
        {inner == 0 ? outer * 0.7071 : 0.5 * (inner + outer), solid_angle, weight, inner == 0 ? 6 : 12});
    all += weight;
    inner = outer;
    outer *= kWider;
  }
  for (Ring& ring : rings) ring.weight /= all;
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
      tap.weight = static_cast<float>(ring.weight / ring.places);
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

// Bilinear look-ups at one height and `row.size()` places that go once around, the first half a step after
// `column` (of the whole turn). The width is a power of two, as the number of places is.
void add_row(const SkyPicture& picture, double column, double height, float weight,
             std::vector<std::array<float, 4>>& row) {
  const double y = height * picture.height - 0.5,
               step = static_cast<double>(picture.width) / static_cast<double>(row.size());
  const auto upper = static_cast<int>(std::floor(y));
  const auto ty = static_cast<float>(y - upper);
  const int mask = picture.width - 1, last = picture.height - 1;
  const std::array<float, 4>*const above = &picture.at(0, std::clamp(upper, 0, last)),
                                   *const below = &picture.at(0, std::clamp(upper + 1, 0, last));
  const double first = column * picture.width + 0.5 * step - 0.5;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double x = first + step * static_cast<double>(i);
    const auto left = static_cast<int>(x + picture.width) - picture.width;  // x >= -1 / 2
    const auto tx = static_cast<float>(x - left);
    const int x0 = left & mask, x1 = (left + 1) & mask;
    const float wa = weight * (1 - tx) * (1 - ty), wb = weight * tx * (1 - ty), wc = weight * (1 - tx) * ty,
                wd = weight * tx * ty;
    for (std::size_t c = 0; c < 4; ++c) {
      row[i][c] += wa * above[x0][c] + wb * above[x1][c] + wc * below[x0][c] + wd * below[x1][c];
    }
  }
}

void add_taps(const std::vector<SkyPicture>& from, const std::vector<Tap>& taps,
              std::vector<std::array<float, 4>>& row) {
  for (const Tap& tap : taps) {
    const auto finer = static_cast<std::size_t>(tap.level);
    if (tap.finer > 0) add_row(from[finer], tap.columns, tap.height, tap.weight * tap.finer, row);
    if (tap.finer < 1) add_row(from[finer + 1], tap.columns, tap.height, tap.weight * (1 - tap.finer), row);
  }
}

// Rings whose places stand for more than this many texels along each axis are as well summed for a sixteenth
// of the texels, where a picture has that many columns.
constexpr double kFarTexels = 4;
constexpr int kWidthOfFar = 256;

}  // namespace

SkyPicture blurred(const std::vector<SkyPicture>& from, double alpha, int width,
                   const ParallelFor& parallel) {
  const double texel = glm::two_pi<double>() / width;
  std::vector<Ring> near = rings_of(alpha, texel), far;
  if (width >= kWidthOfFar) {
    const auto first = std::find_if(near.begin(), near.end(), [&](const Ring& ring) {
      return std::sqrt(ring.solid_angle / ring.places) > kFarTexels * texel;
    });
    far.assign(first, near.end());
    near.erase(first, near.end());
  }
  const auto sum = [&](const std::vector<Ring>& rings, SkyPicture& out, const SkyPicture* beside) {
    const int row_texels = out.width;
    out.texels.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
    parallel(out.height, [&](int y) {
      std::vector<std::array<float, 4>> row(static_cast<std::size_t>(row_texels));
      const double height = (y + 0.5) / out.height;
      add_taps(from, taps_of(height, rings, static_cast<int>(from.size()), from.front().width), row);
      if (beside) add_row(*beside, 0, height, 1, row);
      std::copy(row.begin(), row.end(), out.texels.begin() + static_cast<std::ptrdiff_t>(y) * row_texels);
    });
  };
  SkyPicture coarse{width / 4, width / 8, {}}, out{width, width / 2, {}};
  if (!far.empty()) sum(far, coarse, nullptr);
  sum(near, out, far.empty() ? nullptr : &coarse);
  return out;
}

}  // namespace herr
