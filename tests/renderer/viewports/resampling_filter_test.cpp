// Samples -> viewport pixels by each filter: of what order its error is, at pole and seam too, what it
// clamps, and where the samples of a planar buffer lie among the pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "tests/renderer/busy_scene.h"
#include "tests/renderer/half_pixels.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"
#include "tests/renderer/viewports/viewport_jobs.h"

namespace herr {
namespace {

using test::gaze_deg;
using test::PolarPicture;
using test::viewport_deg;

constexpr ResampleFilter kFilters[]{ResampleFilter::nearest, ResampleFilter::bilinear,
                                    ResampleFilter::bicubic};

// Values up to 1 are rounded to half twice, by 2^-12 at most: as texels, of which bicubic weights' absolute
// values sum up to (1 + 1/4)^2, and as pixels.
constexpr double kRounding = (1.5625 + 1) * 0x1p-12;

// The largest error, up to u = `last`, in the picture of a wave of `waves` radians per radian of direction.
double largest_error(const Viewport& viewport, const glm::dvec3& gaze, double waves, double last, int width,
                     int height, ResampleFilter filter, Isa isa) {
  PolarPicture picture(viewport, gaze, width, height);
  picture.job.filter = filter;
  picture.job.exact_below_deg = 180;  // no cells: they move coordinates by up to 1/16 sample
  double largest = 0;
  for (const glm::dvec3& along :
       {picture.frame.right, picture.frame.up,
        glm::normalize(picture.frame.right - 1.7 * picture.frame.up + 0.2 * picture.frame.gaze)}) {
    const auto wave = [&](const glm::dvec3& d) {
      return 0.5 + 0.5 * std::sin(waves * glm::dot(along, d) + 0.4);
    };
    picture.fill(wave);
    picture.composite(isa);
    test::for_each_pixel(picture.image, [&](int x, int y, const test::Pixel& pixel) {
      const glm::dvec3 d = test::direction_of_pixel(viewport, x, y);
      const double u = picture.map.u_from_theta(eccentricity_deg(picture.frame.gaze, d));
      if (u < last) largest = std::max(largest, std::abs(pixel[0] - wave(d)));
    });
  }
  return largest;
}

// Halving the spacing of samples divides the error of a wave that has some samples per radian by 2 (nearest),
// 4 (bilinear) or 8 (bicubic, whose third-order term is the wave's steepest third derivative).
void expect_order(const Viewport& viewport, const glm::dvec3& gaze, double waves, int width, int height,
                  Isa isa) {
  const double last =
      (width - 1.5) / width;  // column W - 2 of the coarse buffer: no fetch meets the border there
  for (const ResampleFilter filter : kFilters) {
    const int order = 1 + static_cast<int>(filter);
    const double coarse = largest_error(viewport, gaze, waves, last, width, height, filter, isa);
    const double fine = largest_error(viewport, gaze, waves, last, 2 * width, 2 * height, filter, isa);
    const double expected = coarse / (1 << order);
    std::cout << name_of(isa) << ", order " << order << ": " << coarse << ", " << fine << " = 1 / "
              << coarse / fine << '\n';
    // A quarter for terms of higher order in the coarser picture: in the next one they are half as large.
    EXPECT_LE(fine, 1.25 * expected + kRounding) << "order " << order;
    EXPECT_GE(fine, 0.75 * expected - kRounding) << "order " << order;
    EXPECT_GT(expected, 2 * kRounding) << "or the error is mere rounding";
  }
}

// 1.4 degrees around the pole, of which the innermost columns are a good part: log1p(1.41 degrees) / 8
// columns is 0.11 degrees at the pole, where a wave of 350 advances by 0.67 radian a sample. With a wrong
// sample across the pole the finer picture of the bicubic filter is off by 0.0066 instead of 0.0030.
TEST(ResamplingFilterTest, ErrorsFallByTheOrderOfTheFilterAroundThePole) {
  const Viewport focus = viewport_deg(Eye::left, 400, 400, -1, 1, -1, 1);
  for (const Isa isa : test::offered_isas()) expect_order(focus, gaze_deg(0, 0), 350, 8, 32, isa);
}

TEST(ResamplingFilterTest, ErrorsFallByTheOrderOfTheFilterInAWideViewport) {
  const Viewport context = viewport_deg(Eye::left, 480, 480, -35, 35, -35, 35);
  expect_order(context, gaze_deg(0, 0), 13, 24, 64, resolve_isa(Isa::best));
  expect_order(context, gaze_deg(-20, 5), 13, 28, 80, resolve_isa(Isa::best));
}

TEST(ResamplingFilterTest, NearestShowsTheSamplesAndNothingElse) {
  PolarPicture picture(viewport_deg(Eye::left, 301, 301, -30, 30, -30, 30), gaze_deg(4, 3), 40, 32);
  picture.job.filter = ResampleFilter::nearest;
  picture.job.exact_below_deg = 180;
  picture.fill([&](const glm::dvec3& d) { return 1 + glm::dot(d, picture.frame.right); });
  picture.composite(resolve_isa(Isa::best));
  int near_borders = 0;
  test::for_each_pixel(picture.image, [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 d = test::direction_of_pixel(picture.viewport, x, y);
    const double column = picture.map.u_from_theta(eccentricity_deg(picture.frame.gaze, d)) * 40;
    const double phi = std::atan2(glm::dot(d, picture.frame.up), glm::dot(d, picture.frame.right));
    const double row = v_from_phi(phi) * 32;
    // Floats may decide otherwise on the border between two samples.
    const auto at_border = [](double at) { return std::abs(at - std::round(at)) < 1e-3; };
    if (at_border(column) || at_border(row)) return void(++near_borders);
    const std::uint16_t* texel = picture.texel(std::min(static_cast<int>(column), 39), static_cast<int>(row));
    ASSERT_EQ(pixel[0], test::from_half(texel[0])) << x << ", " << y;
  });
  EXPECT_LT(near_borders, 301 * 301 / 50);
}

// A step between 0 and the greatest half, and the feed kept not at all or by 4: Catmull-Rom overshoots by up
// to 0.07 of a step along each axis, which would be negative light, infinity, or more than the feed may be
// kept.
TEST(ResamplingFilterTest, BicubicOvershootIsClamped) {
  for (const Isa isa : test::offered_isas()) {
    PolarPicture picture(viewport_deg(Eye::left, 320, 240, -30, 30, -20, 20), gaze_deg(2, 1), 24, 16);
    picture.job.filter = ResampleFilter::bicubic;
    const auto fill = [&](std::uint16_t light, std::uint16_t ratio) {
      for (int row = -kBorderAbove; row < 16 + kBorderBelow; ++row) {
        for (int column = -kBorderLeft; column < 24 + kBorderRight; ++column) {
          const bool bright = (column / 4 + (row + 16) / 4) % 2 == 0;
          std::uint16_t* texel = picture.texel(column, row);
          std::fill_n(texel, 3, bright ? light : std::uint16_t{0});
          texel[3] = bright ? ratio : std::uint16_t{0};
        }
      }
    };
    constexpr std::uint16_t kGreatest = 0x7bff, kFour = 0x4400;
    fill(kGreatest, kFour);
    picture.composite(isa);
    int greatest = 0, dark = 0;
    test::for_each_pixel(picture.image, [&](int x, int y, const test::Pixel& pixel) {
      ASSERT_TRUE(pixel[0] >= 0 && pixel[0] <= 65504) << pixel[0] << " at " << x << ", " << y;
      ASSERT_TRUE(pixel[3] >= -3 && pixel[3] <= 1) << "1 - r is " << pixel[3] << " at " << x << ", " << y;
      greatest += pixel[0] == 65504, dark += pixel[0] == 0;
    });
    EXPECT_GT(greatest, 0);
    EXPECT_GT(dark, 0);
  }
}

// Twice as many pixels as rays along each axis: pixels 2 i and 2 i + 1 lie 1/4 ray to either side of ray i.
TEST(ResamplingFilterTest, NearestAtHalfScaleIsThePictureOfHalfTheSizeWithItsPixelsDoubled) {
  const Scene scene = test::busy_scene();
  RenderSettings settings = test::planar_settings();
  const FrameSample sample = test::sample_from({0, 0, 0});
  for (const Isa isa : test::offered_isas()) {
    settings.isa = isa;
    settings.scale = 1;
    const RenderedFrame small = test::render(scene, test::single_view(37, 22, 40, 30), settings, sample);
    settings.scale = 0.5;
    settings.filter = ResampleFilter::nearest;
    const RenderedFrame doubled = test::render(scene, test::single_view(74, 44, 40, 30), settings, sample);
    EXPECT_EQ(doubled.counters.rays[RayKind::primary], 37 * 22);
    test::for_each_pixel(doubled.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
      ASSERT_EQ(pixel, test::pixel_at(small.viewports[0], x / 2, y / 2)) << x << ", " << y;
    });
  }
}

TEST(ResamplingFilterTest, AtFullScaleNoFilterHasAnythingToDo) {
  const Scene scene = test::busy_scene();
  RenderSettings settings = test::planar_settings();
  const FrameSample sample = test::sample_from({0, 0, 0});
  const RenderedFrame bilinear = test::render(scene, test::small_profile(), settings, sample);
  for (const ResampleFilter filter : kFilters) {
    settings.filter = filter;
    test::expect_same_bits(bilinear, test::render(scene, test::small_profile(), settings, sample));
  }
}

// A planar buffer of 16 x 12 samples for 40 x 26 pixels.
struct PlanarPicture {
  PlanarPicture() {
    buffer.allocate(padded_columns(kColumns), padded_rows(kRows), false);
    image.resize(viewport.width_px, viewport.height_px);
    job.viewport = &viewport;
    job.out = &image;
    job.radiance = &buffer;
    job.polar = false;
    job.planar_width = kColumns, job.planar_height = kRows;
  }
  static constexpr int kColumns = 16, kRows = 12;
  Viewport viewport = viewport_deg(Eye::left, 40, 26, -30, 30, -20, 20);
  RadianceBuffer buffer;
  ViewportImage image;
  ViewportJob job;
};

// A function that is linear along the picture is kept by bilinear and bicubic weights, where these reach no
// border: pixel x lies at (x + 1/2) 16 / 40 - 1/2 samples. Farther out it is clamped to the outermost
// samples.
TEST(ResamplingFilterTest, PixelsLieAmongTheSamplesOfAPlanarBufferByTheirCentres) {
  const auto value = [](double column, double row) { return (8 + 2 * column + 3 * row) / 64; };
  for (const Isa isa : test::offered_isas()) {
    for (const ResampleFilter filter : {ResampleFilter::bilinear, ResampleFilter::bicubic}) {
      PlanarPicture picture;
      picture.job.filter = filter;
      for (int row = -kBorderAbove; row < 12 + kBorderBelow; ++row) {
        for (int column = -kBorderLeft; column < 16 + kBorderRight; ++column) {
          std::uint16_t* texel =
              picture.buffer.texels() + 4 * texel_index(picture.buffer.row_stride(), column, row);
          std::fill_n(texel, 4, test::to_half(value(std::clamp(column, 0, 15), std::clamp(row, 0, 11))));
        }
      }
      StripScratch scratch(40);
      for (int strip = 0; strip < 2; ++strip) composite_strip_for(isa)(picture.job, strip, scratch);
      test::for_each_pixel(picture.image, [&](int x, int y, const test::Pixel& pixel) {
        const double column = (x + 0.5) * 16 / 40 - 0.5, row = (y + 0.5) * 12 / 26 - 0.5;
        const bool inside = column >= 1 && column <= 14 && row >= 1 && row <= 10;
        if (filter == ResampleFilter::bicubic && !inside) return;
        const double expected = value(std::clamp(column, 0.0, 15.0), std::clamp(row, 0.0, 11.0));
        // Texels are multiples of 1/64 and exact; 1e-5 samples of float coordinates.
        ASSERT_NEAR(pixel[0], expected, test::half_rounding(1.1) + 1e-5) << x << ", " << y;
      });
    }
  }
}

}  // namespace
}  // namespace herr
