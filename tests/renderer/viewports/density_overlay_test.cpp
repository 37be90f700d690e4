// Lines of degrees and of sample density, and their numbers.
#include "renderer/viewports/density_overlay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/viewports/overlay_glyphs.h"
#include "tests/renderer/half_pixels.h"
#include "tests/renderer/viewports/viewport_jobs.h"

namespace herr {
namespace {

ViewportImage lines_over(const Viewport& view, const OverlayCircles& circles) {
  ViewportImage image;
  image.resize(view.width_px, view.height_px);
  draw_overlay_lines(view, circles, 0, view.height_px, image);
  return image;
}

double nearest_deg(const OverlayCircles& circles, double theta_deg) {
  double nearest = 1e9;
  for (int i = 0; i < circles.count; ++i) {
    const double off = theta_deg - circles.circles[static_cast<std::size_t>(i)].theta_deg;
    if (std::abs(off) < std::abs(nearest)) nearest = off;
  }
  return std::abs(nearest);
}

// A pixel is 2 tan 20 / 800 = 0.0521 degrees in the middle, and down to cos^2 25 = 0.82 of that at a corner.
TEST(DensityOverlayTest, LinesLieWhereTheirCirclesAre) {
  const Viewport view = test::viewport_deg(Eye::left, 800, 600, -20, 20, -15.3, 15.3);
  for (const glm::dvec3& gaze : {test::gaze_deg(0, 0), test::gaze_deg(12, -7)}) {
    const OverlayCircles circles = degree_circles(gaze_frame(gaze));
    const ViewportImage image = lines_over(view, circles);
    int drawn = 0;
    test::for_each_pixel(image, [&](int x, int y, const test::Pixel& pixel) {
      const double off = nearest_deg(circles, eccentricity_deg(gaze, test::direction_of_pixel(view, x, y)));
      if (pixel[3] == 1.0) {
        ++drawn;
        ASSERT_GT(pixel[2], pixel[0]) << "degrees are blue";
        ASSERT_LT(off, 0.8 * 0.0521) << x << ", " << y;
      } else {
        ASSERT_GT(off, 0.7 * 0.82 * 0.0521) << x << ", " << y;
        ASSERT_EQ(pixel, test::Pixel{}) << "nothing else is touched";
      }
    });
    EXPECT_GT(drawn, 1000);
  }
}

// By the buffer's own formulas: its radius has W / (ln(theta_max + 1) (theta + 1)) samples per degree, the
// circle H / (360 sin theta). 766 x 768 up to 45 degrees: 200.07 / (theta + 1) along the radius.
TEST(DensityOverlayTest, DensityIsThatOfTheDirectionWithFewerSamples) {
  const PolarMap map = PolarMap::up_to(45);
  const OverlayCircles circles = density_circles(gaze_frame({0, 0, -1}), map, 766, 768);
  ASSERT_EQ(circles.count, 5);  // 100, 50, 20, 10, 5; 2 would lie where sin theta = 1.07
  double before = 0;
  for (int i = 0; i < circles.count; ++i) {
    const auto& circle = circles.circles[static_cast<std::size_t>(i)];
    EXPECT_GT(circle.theta_deg, before);
    before = circle.theta_deg;
    const double radial = 766 / (std::log(46.0) * (circle.theta_deg + 1));
    const double angular = 768 / (360 * std::sin(circle.theta_deg * 3.14159265358979 / 180));
    EXPECT_NEAR(std::min(radial, angular), circle.number, 1e-9 * circle.number);
  }
  EXPECT_NEAR(circles.circles[0].theta_deg, 1.0007, 5e-4) << "the radius has fewer";
  EXPECT_NEAR(circles.circles[3].theta_deg, 12.317, 1e-3) << "asin(768 / 3600): the circle has fewer";
}

// Rays s apart on the plane at distance 1 are s cos a radians apart around the axis: 100 over 2 tan 45 are
// 0.02, or 0.8727 per degree in the middle; 1 per degree where cos a = 0.8727, at 29.2 degrees.
TEST(DensityOverlayTest, WithoutFoveationDensityGrowsTowardsTheBorders) {
  const Viewport view = test::viewport_deg(Eye::left, 100, 100, -45, 45, -45, 45);
  const OverlayCircles circles = density_circles(view, 100, 100);
  ASSERT_GE(circles.count, 2);
  EXPECT_EQ(circles.circles[0].number, 1);
  EXPECT_NEAR(circles.circles[0].theta_deg, 29.22, 0.02);
  EXPECT_NEAR(circles.circles[1].theta_deg, 64.13, 0.02) << "2 per degree: cos a = 0.4363";
}

TEST(DensityOverlayTest, EachNumberIsDrawnWholeBesideItsLineAndInsideThePicture) {
  const Viewport view = test::viewport_deg(Eye::left, 1200, 900, -40, 40, -32, 32);
  const glm::dvec3 gaze = test::gaze_deg(25, 10);
  const OverlayCircles circles = degree_circles(gaze_frame(gaze));
  ViewportImage image;
  image.resize(view.width_px, view.height_px);
  draw_overlay_numbers(view, circles, image);
  int black = 0, blue = 0;
  test::for_each_pixel(image, [&](int, int, const test::Pixel& pixel) {
    if (pixel[3] != 1.0) return;
    (pixel[2] > 0.5 ? blue : black)++;
  });
  // "20d" has 11 + 12 + 8 dots of 2 x 2 pixels on a box of 13 x 7: 124 pixels; five numbers have room at
  // least.
  EXPECT_GT(blue, 5 * 60);
  EXPECT_GT(black, blue);
}

TEST(DensityOverlayTest, GlyphsAreOfTheirTextAlone) {
  EXPECT_EQ(glyphs_wide("20/d"), 15);
  EXPECT_TRUE(is_glyph_dot("1", 1, 0));
  EXPECT_FALSE(is_glyph_dot("1", 0, 0));
  EXPECT_FALSE(is_glyph_dot("11", 3, 2)) << "the gap";
  EXPECT_TRUE(is_glyph_dot("11", 5, 0));
  for (const auto& [column, row] : {std::pair{-1, 0}, {0, -1}, {0, 5}, {3, 0}})
    EXPECT_FALSE(is_glyph_dot("8", column, row)) << column << ", " << row;
}

}  // namespace
}  // namespace herr
