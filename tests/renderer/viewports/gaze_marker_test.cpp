// The red ring around the gaze.
#include "renderer/viewports/gaze_marker.h"

#include <gtest/gtest.h>

#include "tests/renderer/half_pixels.h"
#include "tests/renderer/viewports/viewport_jobs.h"

namespace herr {
namespace {

ViewportImage blank(const Viewport& view) {
  ViewportImage image;
  image.resize(view.width_px, view.height_px);
  return image;
}

bool is_red(const test::Pixel& pixel) {
  return pixel[0] == 1.0 && pixel[1] < 0.1 && pixel[2] < 0.1 && pixel[3] == 1.0;
}

TEST(GazeMarkerTest, IsARingOfOneDegreeAroundTheGaze) {
  const Viewport view = test::viewport_deg(Eye::left, 1200, 900, -20, 20, -15, 15);
  for (const glm::dvec3& gaze : {test::gaze_deg(0, 0), test::gaze_deg(12, -7), test::gaze_deg(-19.5, 14.8)}) {
    ViewportImage image = blank(view);
    draw_gaze_marker(view, gaze, image);
    int red = 0;
    test::for_each_pixel(image, [&](int x, int y, const test::Pixel& pixel) {
      const double off = std::abs(eccentricity_deg(gaze, test::direction_of_pixel(view, x, y)) - 1.0);
      // The line is 0.08 degrees wide to each side; a pixel is 0.035 degrees.
      if (is_red(pixel)) {
        ++red;
        ASSERT_LT(off, 0.1) << x << ", " << y;
      } else {
        ASSERT_GT(off, 0.07) << x << ", " << y;
        ASSERT_EQ(pixel, test::Pixel{}) << "nothing else is touched";
      }
    });
    EXPECT_GT(red, 200);
  }
}

TEST(GazeMarkerTest, IsAtLeastAPixelWideInCoarseViewports) {
  const Viewport view = test::viewport_deg(Eye::left, 90, 90, -45, 45, -45, 45);  // a pixel is 1.3 degrees
  ViewportImage image = blank(view);
  draw_gaze_marker(view, {0, 0, -1}, image);
  int red = 0;
  test::for_each_pixel(image, [&](int, int, const test::Pixel& pixel) { red += is_red(pixel); });
  EXPECT_GE(red, 4);
}

TEST(GazeMarkerTest, IsNotDrawnWhenTheGazeIsBehindOrOutside) {
  const Viewport view = test::viewport_deg(Eye::left, 120, 90, -20, 20, -15, 15);
  for (const glm::dvec3& gaze :
       {glm::dvec3{0, 0, 1}, {1, 0, 0}, {0.01, 0, 1}, test::gaze_deg(60, 0), test::gaze_deg(0, 30)}) {
    ViewportImage image = blank(view);
    draw_gaze_marker(view, gaze, image);
    test::for_each_pixel(image, [](int, int, const test::Pixel& pixel) { ASSERT_EQ(pixel, test::Pixel{}); });
  }
}

}  // namespace
}  // namespace herr
