// The gaze as a frame of reference, and how far from it an eye's viewports reach.
#include "renderer/foveation/gaze_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <random>

#include "tests/renderer/viewports/viewport_jobs.h"

namespace herr {
namespace {

using test::gaze_deg;
using test::viewport_deg;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<glm::dvec3> many_gazes() {
  std::vector<glm::dvec3> gazes{{0, 0, -1},
                                {0, 0, 1},
                                {1, 0, 0},
                                {-1, 0, 0},
                                {0, 1, 0},
                                {0, -1, 0},
                                {1, 1, -1},
                                {-1, 1, -1},
                                {1e-9, 0, -1},
                                {1e-9, 1e-9, 1},
                                {1e-4, 0, 1},
                                {4.4e-5, 0, 1},
                                {4.5e-5, 0, 1},
                                {0, -1e-7, 1},
                                {3e-160, 0, -4e-160},
                                {1e150, 2e150, -1e150},
                                gaze_deg(30, 0),
                                gaze_deg(80, 10),
                                gaze_deg(-45, 45),
                                gaze_deg(179, 0)};
  std::mt19937_64 random(21);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 500; ++i) gazes.push_back({normal(random), normal(random), normal(random)});
  return gazes;
}

TEST(GazeFrameTest, IsOrthonormalAndRightHandedForAnyGaze) {
  for (const glm::dvec3& gaze : many_gazes()) {
    const GazeFrame f = gaze_frame(gaze);
    // Quaternion products round each component a handful of times; 1e-9 is the bound on 1 + cos below which
    // the frame is chosen instead of computed, whose axes are then off by its square root at most.
    const double angle = eccentricity_deg(gaze, {0, 0, 1});
    const double tolerance = angle < 0.01 ? 5e-5 : 1e-12;
    EXPECT_NEAR(glm::length(f.right), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(f.up), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(f.gaze), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(f.right, f.up), 0.0, 1e-12);
    EXPECT_NEAR(glm::dot(f.right, f.gaze), 0.0, tolerance) << gaze.x << " " << gaze.y << " " << gaze.z;
    EXPECT_NEAR(glm::dot(f.up, f.gaze), 0.0, tolerance);
    // right x up points at the viewer, away from the gaze: phi turns counter-clockwise as the eye sees it.
    EXPECT_NEAR(glm::dot(glm::cross(f.right, f.up), f.gaze), -1.0, 1e-8);
    EXPECT_LT(eccentricity_deg(f.gaze, gaze), 1e-10);
  }
}

TEST(GazeFrameTest, StraightAheadIsTheEyesOwnFrame) {
  const GazeFrame f = gaze_frame({0, 0, -2.5});
  EXPECT_EQ(f.right, glm::dvec3(1, 0, 0));
  EXPECT_EQ(f.up, glm::dvec3(0, 1, 0));
  EXPECT_EQ(f.gaze, glm::dvec3(0, 0, -1));
}

TEST(GazeFrameTest, TurnsWithoutRolling) {
  // To the right by 30 degrees: up stays, right turns with the gaze.
  const GazeFrame f = gaze_frame(gaze_deg(30, 0));
  EXPECT_NEAR(glm::distance(f.up, {0, 1, 0}), 0.0, 1e-15);
  EXPECT_NEAR(glm::distance(f.right, {std::cos(glm::radians(30.0)), 0, std::sin(glm::radians(30.0))}), 0.0,
              1e-15);
}

TEST(GazeFrameTest, AGazeThatIsNoDirectionGivesStraightAhead) {
  for (const glm::dvec3& gaze :
       {glm::dvec3{0, 0, 0}, {kNaN, 0, -1}, {0, kNaN, 0}, {kInfinity, 0, 0}, {0, 0, -kInfinity}}) {
    const GazeFrame f = gaze_frame(gaze);
    EXPECT_EQ(f.right, glm::dvec3(1, 0, 0));
    EXPECT_EQ(f.gaze, glm::dvec3(0, 0, -1));
  }
}

TEST(GazeFrameTest, EccentricityIsAccurateAtBothPoles) {
  // acos would lose the first two: cos(1e-9 deg) is 1 in double.
  for (const double angle : {1e-9, 1e-5, 0.001, 1.0, 90.0, 179.0, 180.0 - 1e-9, 180.0}) {
    const double rad = angle / kDegreesPerRadian;
    const glm::dvec3 direction{std::sin(rad), 0, -std::cos(rad)};
    // sin and cos are rounded to 2^-53, which near 180 degrees is 1.3e-14 degrees absolute.
    EXPECT_NEAR(eccentricity_deg({0, 0, -1}, 3.0 * direction), angle, 1e-13 + 1e-15 * angle);
  }
}

// Uniform in angle between two directions.
glm::dvec3 slerp(const glm::dvec3& a, const glm::dvec3& b, double t) {
  const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
  if (angle < 1e-12) return a;
  return (std::sin((1 - t) * angle) * a + std::sin(t * angle) * b) / std::sin(angle);
}

struct BruteForce {
  double border_deg = 0, inside_deg = 0, border_step_deg = 0, inside_step_deg = 0;
};

// The farthest of many points, on the border and inside.
BruteForce farthest_of_many(const Viewport& v, const glm::dvec3& gaze) {
  const glm::dvec3 corner[4] = {glm::normalize(glm::dvec3{v.tan_left, v.tan_down, -1}),
                                glm::normalize(glm::dvec3{v.tan_right, v.tan_down, -1}),
                                glm::normalize(glm::dvec3{v.tan_right, v.tan_up, -1}),
                                glm::normalize(glm::dvec3{v.tan_left, v.tan_up, -1})};
  BruteForce found;
  constexpr int kBorder = 1000, kInside = 60;
  for (int side = 0; side < 4; ++side) {
    const glm::dvec3 a = corner[side], b = corner[(side + 1) % 4];
    found.border_step_deg = std::max(found.border_step_deg, eccentricity_deg(a, b) / kBorder);
    for (int i = 0; i <= kBorder; ++i) {
      found.border_deg = std::max(found.border_deg, eccentricity_deg(gaze, slerp(a, b, i / double{kBorder})));
    }
  }
  // Even steps in the angles of both axes: two neighbours are no farther apart than that,
  // whatever the other axis.
  const double left = std::atan(v.tan_left), right = std::atan(v.tan_right), down = std::atan(v.tan_down),
               up = std::atan(v.tan_up);
  for (int j = 0; j <= kInside; ++j) {
    for (int i = 0; i <= kInside; ++i) {
      const double x = std::tan(left + (right - left) * i / kInside),
                   y = std::tan(down + (up - down) * j / kInside);
      found.inside_deg = std::max(found.inside_deg, eccentricity_deg(gaze, {x, y, -1}));
    }
  }
  // Any point is within half a step of a grid point on both axes.
  found.inside_step_deg = ((right - left) + (up - down)) / 2 / kInside * kDegreesPerRadian;
  return found;
}

TEST(ThetaMaxTest, AgreesWithTheFarthestOfManyPoints) {
  const std::vector<Viewport> viewports{viewport_deg(Eye::left, 64, 64, -45, 45, -45, 45),
                                        viewport_deg(Eye::left, 64, 64, -20, 20, -11.57, 11.57),
                                        viewport_deg(Eye::left, 64, 64, -60, 30, -20, 50),
                                        viewport_deg(Eye::left, 64, 64, 10, 40, 5, 6),
                                        viewport_deg(Eye::left, 64, 64, -89.5, 89.5, -89.5, 89.5),
                                        viewport_deg(Eye::left, 64, 64, -89.5, 89.5, -5, 5)};
  std::mt19937_64 random(22);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec3> gazes{{0, 0, -1},      {0, 0, 1},        {1, 0, 0},
                                gaze_deg(80, 0), gaze_deg(45, 45), gaze_deg(-179, 1)};
  for (int i = 0; i < 40; ++i) gazes.push_back({normal(random), normal(random), normal(random)});
  for (std::size_t i = 0; i < viewports.size(); ++i) {
    for (const glm::dvec3& gaze : gazes) {
      SCOPED_TRACE(testing::Message()
                   << "viewport " << i << ", gaze " << gaze.x << " " << gaze.y << " " << gaze.z);
      const GazeFrame frame = gaze_frame(gaze);
      const double found = theta_max_deg(frame, {&viewports[i], 1}, Eye::left);
      const BruteForce brute = farthest_of_many(viewports[i], frame.gaze);
      // Never less than any point; rounding of a few 2^-53 rad.
      EXPECT_GE(found, std::max(brute.border_deg, brute.inside_deg) - 1e-9);
      // Eccentricity changes no faster than the point moves: the maximum is within a step of some point.
      if (found < 180.0) {
        EXPECT_LE(found, brute.border_deg + brute.border_step_deg);
      } else {
        EXPECT_GE(std::max(brute.border_deg, brute.inside_deg), 180.0 - brute.inside_step_deg);
      }
    }
  }
}

TEST(ThetaMaxTest, ClosedFormsHold) {
  const Viewport square = viewport_deg(Eye::right, 64, 64, -45, 45, -45, 45);
  // Straight ahead the farthest point is a corner (1, 1, 1): acos(1 / sqrt 3) = 54.7356 degrees.
  EXPECT_NEAR(theta_max_deg(gaze_frame({0, 0, -1}), {&square, 1}, Eye::right), 54.735610317245346, 1e-12);
  // From one corner to the opposite one, (1, 1, 1) to (-1, -1, 1): acos(-1 / 3) = 109.4712 degrees.
  EXPECT_NEAR(theta_max_deg(gaze_frame({1, 1, -1}), {&square, 1}, Eye::right), 109.47122063449069, 1e-12);
  EXPECT_EQ(theta_max_deg(gaze_frame({0, 0, 1}), {&square, 1}, Eye::right), 180.0);
  // The border itself belongs to the viewport.
  EXPECT_NEAR(theta_max_deg(gaze_frame({1, 0, 1}), {&square, 1}, Eye::right), 180.0, 1e-5);
}

TEST(ThetaMaxTest, OnlyTheEyesOwnViewportsCount) {
  const std::vector<Viewport> both{viewport_deg(Eye::left, 64, 64, -45, 45, -45, 45),
                                   viewport_deg(Eye::right, 64, 64, -10, 10, -10, 10)};
  const GazeFrame ahead = gaze_frame({0, 0, -1});
  EXPECT_NEAR(theta_max_deg(ahead, both, Eye::left), 54.735610317245346, 1e-12);
  // tan(10 deg) sqrt 2 = 0.24937: 14.0021 degrees.
  EXPECT_NEAR(theta_max_deg(ahead, both, Eye::right),
              std::atan(std::sqrt(2.0) * std::tan(10.0 / kDegreesPerRadian)) * kDegreesPerRadian, 1e-12);
  EXPECT_EQ(theta_max_deg(ahead, {both.data(), 1}, Eye::right), 0.0);
}

}  // namespace
}  // namespace herr
