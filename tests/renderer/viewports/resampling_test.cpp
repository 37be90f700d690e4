// Polar buffer -> viewport: what a constant and a linear function of direction become.
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

TEST(ResamplingTest, AConstantImageSurvivesBitForBitOnEveryInstructionSet) {
  constexpr std::uint16_t kTexel[4]{0x3555, 0x0001, 0x7bff,
                                    0x3400};  // 1/3, the least half, the greatest, 1/4
  for (const Isa isa : test::offered_isas()) {
    for (const glm::dvec3& gaze : {gaze_deg(0, 0), gaze_deg(45, 45), gaze_deg(80, 0), gaze_deg(180, 0)}) {
      PolarPicture picture(viewport_deg(Eye::left, 333, 217, -45, 45, -30, 30), gaze, 97, 64);
      for (int row = -kBorderAbove; row < 64 + kBorderBelow; ++row) {
        for (int column = -kBorderLeft; column < 97 + kBorderRight; ++column)
          std::copy_n(kTexel, 4, picture.texel(column, row));
      }
      for (const ResampleFilter filter :
           {ResampleFilter::nearest, ResampleFilter::bilinear, ResampleFilter::bicubic}) {
        picture.job.filter = filter;
        picture.composite(isa);
        for (int y = 0; y < 217; ++y) {
          for (int x = 0; x < 333; ++x) {
            const std::uint16_t* p = picture.image.row(y) + 4 * x;
            ASSERT_TRUE(std::equal(p, p + 3, kTexel)) << name_of(isa) << " at " << x << ", " << y;
            ASSERT_EQ(p[3], 0x3a00) << "coverage is 1 - r = 3/4";
          }
        }
      }
    }
  }
}

constexpr double kSlope = 0.4;

// How far bilinear interpolation may leave f = 1.5 + kSlope a.d (|a| = 1) at eccentricity theta.
double bound_at(const PolarPicture& picture, double theta_deg) {
  const double width = picture.job.polar_width, height = picture.job.polar_height;
  const double per_column = picture.map.log_range / width;
  // The farther end of the cell, where steps are largest; at most 1 column away.
  const double theta = std::min((1 + theta_deg) * std::exp(per_column) - 1, 180.0);
  const double theta_c = (1 + theta) * per_column / kDegreesPerRadian, theta_cc = theta_c * per_column;
  const double ring = theta < 90 ? std::sin(theta / kDegreesPerRadian) : 1.0;
  const double phi_r = 2 * glm::pi<double>() / height;
  // Along the column the great circle bends f by theta'^2 and the spacing by theta'';
  // along the row the circle.
  const double curvature = (theta_c * theta_c + theta_cc + ring * phi_r * phi_r) / 8;
  const double coordinates = (theta_c + ring * phi_r) / 16;  // cells: 1/16 sample in each axis
  // Outside the last sample's centre its value is repeated: up to half a column.
  const double column = picture.map.u_from_theta(theta_deg) * width - 0.5;
  const double edge = column > width - 1 ? 0.5 * theta_c : 0.0;
  constexpr double kLargest = 1.5 + kSlope;
  return kSlope * (curvature + coordinates + edge) + 2 * test::half_rounding(kLargest) + 1e-6;
}

void expect_linear_function_survives(const Viewport& viewport, const glm::dvec3& gaze, int width, int height,
                                     Isa isa) {
  PolarPicture picture(viewport, gaze, width, height);
  double closest = 0;
  for (const glm::dvec3& along :
       {picture.frame.right, picture.frame.up, glm::normalize(glm::dvec3{0.3, -0.5, 0.8})}) {
    const auto f = [&](const glm::dvec3& d) { return 1.5 + kSlope * glm::dot(along, d); };
    picture.fill(f);
    picture.composite(isa);
    int wrong = 0;
    test::for_each_pixel(picture.image, [&](int x, int y, const test::Pixel& pixel) {
      const glm::dvec3 d = test::direction_of_pixel(viewport, x, y);
      const double bound = bound_at(picture, eccentricity_deg(picture.frame.gaze, d));
      const double error = std::abs(pixel[0] - f(d));
      closest = std::max(closest, error / bound);
      if (error > bound && ++wrong < 5)
        ADD_FAILURE() << x << ", " << y << ": off by " << error << " > " << bound;
    });
    EXPECT_EQ(wrong, 0) << "gaze " << gaze.x << " " << gaze.y << " " << gaze.z;
  }
  std::cout << name_of(isa) << ": worst error " << closest << " of its bound\n";
}

TEST(ResamplingTest, ALinearFunctionOfDirectionSurvivesAcrossSeamAndPole) {
  // The pole in the picture, and the seam (phi = 0, to the right of the gaze) with it.
  const Viewport context = viewport_deg(Eye::left, 495, 495, -45, 45, -45, 45);
  for (const glm::dvec3& gaze : {gaze_deg(0, 0), gaze_deg(7.3, -4.1), gaze_deg(45, 45), gaze_deg(80, 0)}) {
    expect_linear_function_survives(context, gaze, 394, 384, resolve_isa(Isa::best));
  }
}

TEST(ResamplingTest, ALinearFunctionSurvivesWithTheGazeBehind) {
  const Viewport context = viewport_deg(Eye::left, 495, 495, -45, 45, -45, 45);
  for (const glm::dvec3& gaze : {gaze_deg(180, 0), gaze_deg(170, 5)}) {
    expect_linear_function_survives(context, gaze, 394, 384, resolve_isa(Isa::best));
  }
}

TEST(ResamplingTest, ALinearFunctionSurvivesCoarseBuffersOnEveryInstructionSet) {
  const Viewport focus = viewport_deg(Eye::right, 240, 135, -20, 20, -11.57, 11.57);
  for (const Isa isa : test::offered_isas()) {
    expect_linear_function_survives(focus, gaze_deg(5, 3), 48, 48, isa);
  }
}

TEST(ResamplingTest, ASamplesOwnDirectionShowsItsTexel) {
  // One texel stands out; the pixels that show it most lie around its direction.
  PolarPicture picture(viewport_deg(Eye::left, 901, 901, -45, 45, -45, 45), gaze_deg(0, 0), 64, 64);
  picture.fill([](const glm::dvec3&) { return 0.0; });
  constexpr int kColumn = 40, kRow = 13;
  picture.texel(kColumn, kRow)[0] = 0x3c00;
  picture.composite(resolve_isa(Isa::best));
  glm::dvec3 sum{0.0};
  test::for_each_pixel(picture.image, [&](int x, int y, const test::Pixel& pixel) {
    // A pixel's solid angle, so that the centroid lies on the sphere and not on the plane.
    const glm::dvec3 d = test::direction_of_pixel(picture.viewport, x, y);
    sum += pixel[0] * std::pow(-d.z, 3) * d;
  });
  const double theta = eccentricity_deg({0, 0, -1}, sum), phi = std::atan2(sum.y, sum.x);
  // The bilinear tent is symmetric in (column, row); its spread of a column and a curved metric move the
  // centroid by less than a tenth of a sample.
  EXPECT_NEAR(picture.map.u_from_theta(theta) * 64 - 0.5, kColumn, 0.2);
  EXPECT_NEAR(v_from_phi(phi) * 64 - 0.5, kRow, 0.05);
}

}  // namespace
}  // namespace herr
