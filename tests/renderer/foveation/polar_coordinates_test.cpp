// Where the viewport stage fetches from, read back at every pixel and held against double precision.
// The buffer's texels say where they lie: triangle waves of the column and the row, each twice, a quarter
// period apart, so that one of the two is always away from its turning points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "tests/renderer/half_pixels.h"
#include "tests/renderer/viewports/viewport_jobs.h"

namespace herr {
namespace {

using test::gaze_deg;
using test::PolarPicture;
using test::viewport_deg;

constexpr double kPeriod =
    32.0;  // samples; divides the heights used here, so that the wave closes at the seam

// Between -8 and 8, slope +-1; linear between whole numbers, so that bilinear interpolation keeps it exact.
double wave(double x) {
  const double phase = x - kPeriod * std::floor(x / kPeriod);
  return std::abs(phase - kPeriod / 2) - kPeriod / 4;
}

void write_positions(PolarPicture& picture) {
  for (int row = 0; row <= picture.job.polar_height; ++row) {
    for (int column = -1; column <= picture.job.polar_width; ++column) {
      std::uint16_t* texel = picture.texel(column, row);
      texel[0] = test::to_half(wave(column));
      texel[1] = test::to_half(wave(column + kPeriod / 4));
      texel[2] = test::to_half(wave(row));
      texel[3] = test::to_half(wave(row + kPeriod / 4));
    }
  }
}

struct Worst {
  double column = 0, row = 0;  // samples, beyond what float and half explain
  int x = 0, y = 0;
};

// The largest distance of the kernel's coordinates from the exact ones.
Worst worst_coordinate(const PolarPicture& picture) {
  const ViewportJob& job = picture.job;
  const double width = job.polar_width, height = job.polar_height;
  // Half: waves reach 8, where halfs are 2^-7 apart above and 2^-8 below. (alpha is 1 - wave: up to 9.)
  constexpr double kReading = 0x1p-8;
  // A pixel's direction is base + x per_x + y per_y in float, components up to 1.5 (focus) or more (wide
  // views): base and steps are rounded (a step's error grows with x), and each multiply-add rounds once: four
  // times 2^-24 of the largest component, against a direction of at least that length.
  constexpr double kDirection_rad = 4 * 0x1p-24;
  // The vector functions are good to 4 ulp: of theta, log1p and phi. Then the columns' own float spacing.
  constexpr double kFunctions = 4 * 0x1p-23;
  Worst worst;
  test::for_each_pixel(picture.image, [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 d = test::direction_of_pixel(*job.viewport, x, y);
    const double right = glm::dot(d, picture.frame.right), up = glm::dot(d, picture.frame.up);
    const double theta = eccentricity_deg(picture.frame.gaze, d), sine = std::hypot(right, up);
    const double column = std::clamp(picture.map.u_from_theta(theta) * width - 0.5, -0.5, width - 0.5);
    const double row = v_from_phi(std::atan2(up, right)) * height - 0.5;

    const double column_error =
        std::max(std::abs(pixel[0] - wave(column)), std::abs(pixel[1] - wave(column + kPeriod / 4)));
    const double row_error =
        std::max(std::abs(pixel[2] - wave(row)), std::abs((1.0 - pixel[3]) - wave(row + kPeriod / 4)));
    const double column_slack =
        picture.map.radial_density(theta, width) * (kDirection_rad * kDegreesPerRadian + kFunctions * theta) +
        2 * kFunctions * width + kReading;
    // Near the pole phi itself is uncertain: the direction's error turns it by error / sin(theta).
    const double row_slack = height / (2 * glm::pi<double>()) *
                                 std::min(kDirection_rad / std::max(sine, 1e-9), 2 * glm::pi<double>()) +
                             2 * kFunctions * height + kReading;
    const double by_column = column_error - column_slack, by_row = row_error - row_slack;
    if (std::max(by_column, by_row) > std::max(worst.column, worst.row)) worst.x = x, worst.y = y;
    worst.column = std::max(worst.column, by_column);
    worst.row = std::max(worst.row, by_row);
  });
  return worst;
}

void expect_coordinates(const Viewport& viewport, const glm::dvec3& gaze, int width, int height, Isa isa) {
  PolarPicture picture(viewport, gaze, width, height);
  write_positions(picture);
  picture.composite(isa);
  const Worst worst = worst_coordinate(picture);
  std::cout << name_of(isa) << " " << viewport.width_px << "x" << viewport.height_px << " gaze " << gaze.x
            << " " << gaze.y << " " << gaze.z << ": cells from " << picture.job.exact_below_deg
            << " deg, worst column " << worst.column << ", row " << worst.row << " samples\n";
  EXPECT_LT(worst.column, 1.0 / 16) << "at pixel " << worst.x << ", " << worst.y;
  EXPECT_LT(worst.row, 1.0 / 16) << "at pixel " << worst.x << ", " << worst.y;
}

// Gazes at the centre, a corner, 30 degrees off, 80 degrees off, near the antipode, behind.
const std::vector<glm::dvec3>& gazes() {
  static const std::vector<glm::dvec3> list{{0, 0, -1},      gaze_deg(4.3, -2.7), {1, 1, -1},
                                            gaze_deg(30, 7), gaze_deg(80, -10),   gaze_deg(170, 20),
                                            {0, 0, 1}};
  return list;
}

TEST(PolarCoordinatesTest, FocusViewportOfXr1IsWithinASixteenthSampleAtEveryPixel) {
  const Viewport focus = viewport_deg(Eye::left, 2400, 1350, -20, 20, -11.57, 11.57);
  for (const glm::dvec3& gaze : {gazes()[0], gazes()[2], gazes()[3]}) {
    expect_coordinates(focus, gaze, 788, 768, resolve_isa(Isa::best));
  }
}

TEST(PolarCoordinatesTest, ContextViewportOfXr1IsWithinASixteenthSampleAtEveryPixel) {
  const Viewport context = viewport_deg(Eye::left, 1980, 1980, -45, 45, -45, 45);
  expect_coordinates(context, gazes()[1], 788, 768, resolve_isa(Isa::best));
}

TEST(PolarCoordinatesTest, HalfSizeIsWithinASixteenthSampleForEveryGaze) {
  const Viewport context = viewport_deg(Eye::left, 990, 990, -45, 45, -45, 45);
  for (const glm::dvec3& gaze : gazes()) expect_coordinates(context, gaze, 788, 768, resolve_isa(Isa::best));
}

TEST(PolarCoordinatesTest, EveryInstructionSetIsWithinASixteenthSample) {
  const Viewport lopsided = viewport_deg(Eye::left, 395, 410, -60, 35, -30, 52);
  for (const Isa isa : test::offered_isas()) {
    for (const glm::dvec3& gaze : {gazes()[1], gazes()[4]}) expect_coordinates(lopsided, gaze, 256, 256, isa);
  }
}

TEST(PolarCoordinatesTest, AViewOf179DegreesIsWithinASixteenthSample) {
  const Viewport wide = viewport_deg(Eye::left, 640, 480, -89.5, 89.5, -60, 60);
  for (const glm::dvec3& gaze : {gazes()[0], gazes()[3]}) {
    expect_coordinates(wide, gaze, 394, 384, resolve_isa(Isa::best));
  }
}

TEST(PolarCoordinatesTest, SomeCellsAreInterpolatedAndSomeAreExact) {
  // Otherwise the tests above would test one way only.
  const PolarPicture picture(viewport_deg(Eye::left, 1980, 1980, -45, 45, -45, 45), {0, 0, -1}, 788, 768);
  EXPECT_GT(picture.job.exact_below_deg, 0.5f);
  EXPECT_LT(picture.job.exact_below_deg, 20.0f);
}

}  // namespace
}  // namespace herr
