// What lobes are shown of a picture, against sums over all of its directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec3.hpp>

#include "renderer/environment/bright_sources.h"
#include "renderer/environment/filtered_environment.h"

namespace herr {
namespace {

void one_by_one(int count, const std::function<void(int)>& job) {
  for (int i = 0; i < count; ++i) job(i);
}

// Even waves, and where asked for a patch of 12 by 12 texels that is 100 times as bright.
EnvironmentImage picture_of(bool with_patch) {
  EnvironmentImage picture;
  picture.width_px = 256;
  picture.height_px = 128;
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      const double wave = 1 + 0.5 * std::sin(0.11 * y) * std::cos(0.0490873852 * 3 * x);
      const bool bright = with_patch && x >= 60 && x < 72 && y >= 40 && y < 52;
      const auto value = static_cast<float>(bright ? 100.0 : wave);
      picture.rgba.insert(picture.rgba.end(), {value, 0.5f * value, 0.25f * value, 0.0f});
    }
  }
  return picture;
}

double bilinear(const float* texels, int width, int height, const glm::dvec3& d) {
  const double u = std::atan2(d.x, -d.z) / glm::two_pi<double>() + 0.5,
               v = std::acos(d.y) / glm::pi<double>();
  const double x = u * width - 0.5, y = v * height - 0.5, left = std::floor(x), upper = std::floor(y);
  double sum = 0;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const int column = (static_cast<int>(left) + i + width) % width;
      const int row = std::clamp(static_cast<int>(upper) + j, 0, height - 1);
      sum += (i == 0 ? 1 - (x - left) : x - left) * (j == 0 ? 1 - (y - upper) : y - upper) *
             double{texels[4 * (row * width + column)]};
    }
  }
  return sum;
}

// GGX seen head on, times Smith's masking of the other way; the same constant left out everywhere.
double lobe(double cosine, double alpha2) {
  if (cosine <= 0) return 0;
  const double half2 = 0.5 * (1 + cosine), bottom = half2 * (alpha2 - 1) + 1;
  return alpha2 / (bottom * bottom) * 2 * cosine /
         (cosine + std::sqrt(alpha2 + (1 - alpha2) * cosine * cosine));
}

template <typename Weight>
double mean_over(const EnvironmentImage& picture, const Weight& weight) {
  constexpr int kWidth = 768, kHeight = 384;
  double sum = 0, weights = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double azimuth = ((x + 0.5) / kWidth - 0.5) * glm::two_pi<double>(),
                   polar = (y + 0.5) / kHeight * glm::pi<double>();
      const glm::dvec3 d{std::sin(polar) * std::sin(azimuth), std::cos(polar),
                         -std::sin(polar) * std::cos(azimuth)};
      const double w = weight(d) * std::sin(polar);
      if (w <= 0) continue;
      weights += w;
      sum += w * bilinear(picture.rgba.data(), picture.width_px, picture.height_px, d);
    }
  }
  return sum / weights;
}

const glm::dvec3 kDirections[] = {
    {0, 0, -1}, {0.6, 0.64, 0.48}, {-0.28, -0.96, 0}, {0, 1, 0}, {-0.8, 0.36, -0.48}};

double level_at(const FilteredRecord& record, int level, const glm::dvec3& d) {
  const auto k = static_cast<std::size_t>(level);
  return bilinear(record.texels + 4 * record.first_texel[k], record.width[k], record.height[k], d);
}

double alpha_of(const FilteredRecord& record, int level) {
  return double{record.first_alpha} * std::exp2(level / double{record.levels_per_octave});
}

// Rings a third wider each, on which the lobe is taken as even, and texels of 0.7 alpha: 2 %.
TEST(FilteredEnvironmentTest, EachLevelIsTheMeanOverItsLobe) {
  const EnvironmentImage picture = picture_of(false);
  const FilteredEnvironment filtered(picture, 64, one_by_one);
  const FilteredRecord record = filtered.record(0);
  EXPECT_EQ(record.source_count, 0);
  EXPECT_NEAR(alpha_of(record, record.levels - 1), 1, 1e-6);
  for (int level = 3; level < record.levels; ++level) {
    const double alpha2 = std::pow(alpha_of(record, level), 2);
    for (const glm::dvec3& d : kDirections) {
      const double mean =
          mean_over(picture, [&](const glm::dvec3& l) { return lobe(glm::dot(d, l), alpha2); });
      EXPECT_NEAR(level_at(record, level, d), mean, 0.02 * mean) << level << ": " << d.x << ", " << d.y;
    }
  }
}

// Light that comes from all sides: rows of a picture times their solid angles.
double light_of(const float* texels, int width, int height) {
  double sum = 0;
  for (int y = 0; y < height; ++y) {
    const double row =
        std::cos(glm::pi<double>() * y / height) - std::cos(glm::pi<double>() * (y + 1) / height);
    for (int x = 0; x < width; ++x) sum += row * double{texels[4 * (y * width + x)]};
  }
  return sum * glm::two_pi<double>() / width;
}

double angle2(const BrightDisc& disc, const glm::dvec3& d) {
  const glm::dvec3 off = glm::dvec3{disc.direction[0], disc.direction[1], disc.direction[2]} - d;
  return glm::dot(off, off);
}

// White of 1 all around, twice as wide as high.
EnvironmentImage even_picture(int width_px) {
  EnvironmentImage picture;
  picture.width_px = width_px;
  picture.height_px = width_px / 2;
  picture.rgba.assign(std::size_t{4} * static_cast<std::size_t>(width_px * picture.height_px), 1.0f);
  return picture;
}

// A square lamp.
void paint(EnvironmentImage& picture, int left, int top, int size, float value) {
  for (int y = top; y < top + size; ++y) {
    for (int x = left; x < left + size; ++x) {
      const int at = 4 * (y * picture.width_px + x);
      std::fill_n(picture.rgba.begin() + at, 3, value);
    }
  }
}

// A sun of 2 by 2 texels, half of all light, stands apart from every level: were it in one as well, surfaces
// would show it twice.
TEST(FilteredEnvironmentTest, ASmallSunIsShownOnce) {
  EnvironmentImage picture = even_picture(1024);
  paint(picture, 300, 200, 2, 1e5f);
  const FilteredEnvironment filtered(picture, 0, one_by_one);
  const FilteredRecord record = filtered.record(0);
  ASSERT_EQ(record.source_count, 1);
  const double all = light_of(picture.rgba.data(), 1024, 512);
  // Half a texel of interpolation at the sun's latitude, and rings of the lobes of what is left: 3 %.
  for (const std::size_t level : {0, 4, 8}) {
    const double rest =
        light_of(record.texels + 4 * record.first_texel[level], record.width[level], record.height[level]);
    EXPECT_NEAR(rest + double{record.sources[0].irradiance[0]}, all, 0.03 * all) << level;
  }
}

// Two lamps of 4 by 4 texels, 10 degrees apart and three to one in power: each is one source of its own
// place, size and parts.
TEST(FilteredEnvironmentTest, EachLampIsASourceOfItsOwn) {
  EnvironmentImage picture = even_picture(1024);
  paint(picture, 500, 254, 4, 3e4f);
  paint(picture, 528, 254, 4, 1e4f);
  SkyPicture sky = resampled(picture, 1024, one_by_one);
  const BrightLight bright = take_bright_sources(sky);
  ASSERT_EQ(bright.sources.size(), 2u);
  const double texel = glm::two_pi<double>() / 1024;
  int parts = 0;
  for (const BrightSource& source : bright.sources) {
    const bool strong = &source == &bright.sources[0];  // what shows most comes first
    const double azimuth = ((strong ? 502 : 530) - 512) * texel;
    EXPECT_LT(angle2(source, {std::sin(azimuth), 0, -std::cos(azimuth)}), std::pow(0.05 * texel, 2));
    const double irradiance = (strong ? 3e4 : 1e4) * 16 * texel * texel;
    EXPECT_NEAR(double{source.irradiance[0]}, irradiance, 0.01 * irradiance);
    // Four texels that fade to nothing a texel further: 15 / 12 for their middles and 1 / 6 for the fading,
    // of the square of a texel's side, along each axis. A disc's rim has twice the mean square, and half
    // vectors turn by half.
    const double half_turn2 = (15.0 / 12 + 1.0 / 6) * texel * texel;
    EXPECT_NEAR(double{source.half_turn2}, half_turn2, 0.02 * half_turn2);
    EXPECT_EQ(source.first_part, parts);
    parts += source.parts;
  }
  EXPECT_EQ(static_cast<int>(bright.parts.size()), parts);
}

// A lamp of 3 by 3 texels and a dimmer one of 12 by 12, whose rim is 5 texels off: the small one stands
// first, and the picture beside the small ones keeps the wide one as it is.
TEST(FilteredEnvironmentTest, WideLampsStayInThePictureOfNarrowLobes) {
  EnvironmentImage picture = even_picture(512);
  paint(picture, 300, 122, 3, 1200);
  paint(picture, 200, 122, 12, 700);
  SkyPicture sky = resampled(picture, 512, one_by_one);
  const BrightLight bright = take_bright_sources(sky);
  ASSERT_EQ(bright.sources.size(), 2u);
  ASSERT_EQ(bright.small, 1);
  EXPECT_GT(bright.sources[0].direction[0], 0);  // column 300 of 512 is to the right of -Z
  EXPECT_LT(bright.sources[1].direction[0], 0);
  EXPECT_EQ(bright.without_small.at(205, 127)[0], 700);
  EXPECT_LT(bright.without_small.at(301, 123)[0], 20);  // 8 times the mean, 2.3
  EXPECT_LT(sky.at(205, 127)[0], 20);
  const FilteredRecord record = FilteredEnvironment(picture, 0, one_by_one).record(0);
  EXPECT_EQ(record.small_sources, 1);
  EXPECT_EQ(record.without_small.width, 512);
  // 0.35 texels, as half vectors turn.
  EXPECT_NEAR(record.smooth_alpha, 0.35 * glm::two_pi<double>() / 512, 1e-6);
}

// Sources are lit by the lobe itself, 1 / the lobe's sum of it each: as parts, which lobes of twice their
// width do not tell from points.
TEST(FilteredEnvironmentTest, LevelsLackTheBrightSourcesAlone) {
  const EnvironmentImage picture = picture_of(true);
  const FilteredEnvironment filtered(picture, 0, one_by_one);
  const FilteredRecord record = filtered.record(0);
  ASSERT_GT(record.source_count, 0);
  float widest = 0;
  int parts = 0;
  for (int i = 0; i < record.source_count; ++i) parts += record.sources[static_cast<std::size_t>(i)].parts;
  for (int i = 0; i < parts; ++i) widest = std::max(widest, record.parts[i].half_turn2);
  for (int level = 0; level < record.levels; ++level) {
    const double alpha2 = std::pow(alpha_of(record, level), 2);
    if (alpha2 < 4 * double{widest}) continue;
    double whole = 0;
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i)
      whole += lobe((i + 0.5) / kSteps, alpha2) * glm::two_pi<double>() / kSteps;
    for (const glm::dvec3& d : kDirections) {
      double shown = level_at(record, level, d);
      for (int i = 0; i < parts; ++i) {
        const BrightDisc& part = record.parts[i];
        const glm::dvec3 to{part.direction[0], part.direction[1], part.direction[2]};
        shown += double{part.irradiance[0]} * lobe(glm::dot(d, to), alpha2) / whole;
      }
      const double mean =
          mean_over(picture, [&](const glm::dvec3& l) { return lobe(glm::dot(d, l), alpha2); });
      EXPECT_NEAR(shown, mean, 0.04 * mean) << level << ": " << d.x << ", " << d.y;
    }
  }
}

TEST(FilteredEnvironmentTest, TakenSourcesAndWhatIsLeftAreAllLight) {
  const auto all_light = [](const SkyPicture& of) {
    double sum = 0;
    for (int y = 0; y < of.height; ++y) {
      for (int x = 0; x < of.width; ++x) sum += of.solid_angle(y) * double{of.at(x, y)[1]};
    }
    return sum;
  };
  SkyPicture picture = resampled(picture_of(true), 256, one_by_one);
  const double before = all_light(picture);
  double taken = 0;
  for (const BrightSource& source : take_bright_sources(picture).sources)
    taken += double{source.irradiance[1]};
  EXPECT_GT(taken, 0);
  EXPECT_NEAR(all_light(picture) + taken, before, 1e-5 * before);
}

TEST(FilteredEnvironmentTest, EvenLightIsThatOfTheCosine) {
  // The middle of the patch: azimuth (66 / 256 - 1 / 2) of a turn, 46 / 128 of half a turn from the zenith.
  const glm::dvec3 patch{-0.903, 0.427, -0.044};
  const EnvironmentImage picture = picture_of(true);
  const FilteredEnvironment filtered(picture, 0, one_by_one);
  const EnvironmentRecord even = filtered.record(0).even;
  for (const glm::dvec3& d : kDirections) {
    const double mean = mean_over(picture, [&](const glm::dvec3& l) { return glm::dot(d, l); });
    // A texel is h = 0.2 rad wide, over which the cosine bends by h^2 / 8. A pole takes the row beside it, h
    // / 2 off, where a cosine differs by up to 0.1 of the patch's share of the light, a third. Where the
    // patch is on the horizon, its cosine has a kink, over which interpolation is off by h / 4 at most: times
    // what the patch sends, 100 of 0.078 sr over pi.
    const bool on_horizon = std::abs(glm::dot(d, patch)) < 0.1 + 0.15;  // half a texel, half the patch
    const double most = (d.y == 1 ? 0.04 : 0.01) * mean + (on_horizon ? 0.2 / 4 * 2.48 : 0.0);
    EXPECT_NEAR(bilinear(even.texels, even.width, even.height, d), mean, most) << d.x << ", " << d.y;
  }
}

// A quarter turn counter-clockwise: what lay at -Z lies at -X.
TEST(FilteredEnvironmentTest, SourcesTurnWithThePicture) {
  EnvironmentImage picture = picture_of(false);
  for (int y = 60; y < 68; ++y) {
    for (int x = 124; x < 132; ++x) picture.rgba[static_cast<std::size_t>(4 * (y * 256 + x))] = 500;
  }
  const FilteredEnvironment filtered(picture, 0, one_by_one);
  const FilteredRecord straight = filtered.record(0), turned = filtered.record(0.25f);
  ASSERT_GT(straight.source_count, 0);
  EXPECT_NEAR(straight.sources[0].direction[2], -1, 0.01);
  EXPECT_NEAR(turned.sources[0].direction[0], -1, 0.01);
}

}  // namespace
}  // namespace herr
