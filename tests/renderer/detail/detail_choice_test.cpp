// Choosing simplified meshes by their projected error at the object's eccentricity.
#include "renderer/detail/detail_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace herr {
namespace {

const std::vector<float> kErrors{0.0001f, 0.001f, 0.01f, 0.1f};

DetailBall ball_at(double degrees, double distance_m, double radius_m = 0.0) {
  const double radians = degrees / 57.29577951308232;
  return {{distance_m * std::sin(radians), 0, -distance_m * std::cos(radians)}, radius_m, 1.0};
}

TEST(DetailChoice, AMetreOfErrorTakesAcuityTimesTheAngleThatItSpans) {
  // A point straight ahead, 2 m away: 200 samples / degree * 57.2958 degrees / 2 m.
  EXPECT_NEAR(samples_per_metre({}, ball_at(0, 2)), 200 * 57.29577951308232 / 2, 1e-9);
  // At 19 degrees the acuity is 200 / 20.
  EXPECT_NEAR(samples_per_metre({}, ball_at(19, 2)), 10 * 57.29577951308232 / 2, 1e-6);
  // A display of 60 pixels a degree hides what is finer.
  DetailEye coarse;
  coarse.most_samples_per_deg = 60;
  EXPECT_NEAR(samples_per_metre(coarse, ball_at(0, 2)), 60 * 57.29577951308232 / 2, 1e-9);
  EXPECT_NEAR(samples_per_metre(coarse, ball_at(19, 2)), 10 * 57.29577951308232 / 2, 1e-6);
  // Without foveation it is the same everywhere.
  DetailEye flat;
  flat.foveated = false;
  EXPECT_NEAR(samples_per_metre(flat, ball_at(19, 2)), 200 * 57.29577951308232 / 2, 1e-9);
}

TEST(DetailChoice, ABallIsSeenAtItsNearestPointAndSmallestEccentricity) {
  // Radius 1 at 2 m spans asin(1/2) = 30 degrees: with its centre 30 degrees aside it touches the gaze.
  EXPECT_NEAR(samples_per_metre({}, ball_at(30, 2, 1)), 200 * 57.29577951308232 / 1, 1e-6);
  EXPECT_EQ(samples_per_metre({}, ball_at(0, 2, 2)), std::numeric_limits<double>::infinity());
}

TEST(DetailChoice, TheCoarsestFormWithinHalfASampleIsShown) {
  // Straight ahead at 1 m half a sample is 0.5 / (200 * 57.3) = 4.4e-5 m: no form is good enough. Ten times
  // as far 4.4e-4: the first. At 99 degrees and 10 m a hundred times that, 0.044: the third.
  const std::vector<DetailEye> eyes(1);
  EXPECT_EQ(detail_level(kErrors, eyes, ball_at(0, 1), -1, 0.5), 0);
  EXPECT_EQ(detail_level(kErrors, eyes, ball_at(0, 10), -1, 0.5), 1);
  EXPECT_EQ(detail_level(kErrors, eyes, ball_at(99, 10), -1, 0.5), 3);
  EXPECT_EQ(detail_level(kErrors, eyes, ball_at(0, 1, 3), 4, 0.5), 0) << "within the ball";
  EXPECT_EQ(detail_level({}, eyes, ball_at(0, 10), -1, 0.5), 0) << "a mesh that has no other form";
}

TEST(DetailChoice, TheEyeThatSeesMoreDecides) {
  std::vector<DetailEye> eyes(2);
  eyes[0].gaze = {1, 0, 0};  // looks away from an object 10 m ahead
  EXPECT_EQ(detail_level(kErrors, eyes, ball_at(0, 10), -1, 0.5), 1);
}

TEST(DetailChoice, AScaledObjectHasAScaledError) {
  const std::vector<DetailEye> eyes(1);
  DetailBall ball = ball_at(0, 10);
  ball.scale = 10;  // 0.0001 m of object space are a millimetre here
  EXPECT_EQ(detail_level(kErrors, eyes, ball, -1, 0.5), 0);
}

TEST(DetailChoice, AChoiceStaysBetweenTheTwoBounds) {
  // The first form's error of 1e-4 m is allowed from 0.5 / (200 * 57.3) * d = 1e-4 on: d = 2.2918 m, and a
  // finer form is left for it only where 0.7 of that is: d = 3.274 m.
  const std::vector<DetailEye> eyes(1);
  EXPECT_EQ(detail_level(kErrors, eyes, ball_at(0, 2.2), 0, 0.5), 0);
  EXPECT_EQ(detail_level(kErrors, eyes, ball_at(0, 2.4), 0, 0.5), 0);
  EXPECT_EQ(detail_level(kErrors, eyes, ball_at(0, 3.2), 0, 0.5), 0);
  EXPECT_EQ(detail_level(kErrors, eyes, ball_at(0, 3.3), 0, 0.5), 1);
  EXPECT_EQ(detail_level(kErrors, eyes, ball_at(0, 2.4), 1, 0.5), 1);
  EXPECT_EQ(detail_level(kErrors, eyes, ball_at(0, 2.2), 1, 0.5), 0);
}

TEST(DetailChoice, ATremblingHeadNeverChangesAForm) {
  // +-1 cm about every distance from 0.5 to 20 m: 2 % at most, far inside the 30 % between the bounds.
  const std::vector<DetailEye> eyes(1);
  for (double distance_m = 0.5; distance_m < 20; distance_m *= 1.01) {
    int level = detail_level(kErrors, eyes, ball_at(0, distance_m), -1, 0.5);
    int changes = 0;
    for (int frame = 0; frame < 50; ++frame) {
      const double tremble_m = 0.01 * std::sin(1.7 * frame);
      const int next = detail_level(kErrors, eyes, ball_at(0, distance_m + tremble_m), level, 0.5);
      changes += next != level;
      level = next;
    }
    EXPECT_LE(changes, 1) << "at " << distance_m << " m";
  }
}

TEST(DetailChoice, NothingAllowedIsTheFullMeshEvenForAFormThatLiesNowhereOff) {
  const std::vector<DetailEye> eyes(1);
  const std::vector<float> flat{0.0f, 0.0f, 0.01f};  // forms of a flat grid of triangles
  EXPECT_EQ(detail_level(flat, eyes, ball_at(0, 2), -1, 0.5), 2);
  for (const int former : {-1, 0, 2, 3}) {
    EXPECT_EQ(detail_level(flat, eyes, ball_at(0, 2), former, 0), 0);
    EXPECT_EQ(detail_level(kErrors, eyes, ball_at(170, 1e6), former, 0), 0);
    DetailBall point = ball_at(0, 2);
    point.scale = 0;
    EXPECT_EQ(detail_level(kErrors, eyes, point, former, 0), 0);
  }
}

TEST(DetailChoice, ABallOfNoReachOrNaNGetsSomeForm) {
  const std::vector<DetailEye> eyes(1);
  DetailBall ball = ball_at(0, std::numeric_limits<double>::quiet_NaN());
  const int level = detail_level(kErrors, eyes, ball, -1, 0.5);
  EXPECT_GE(level, 0);
  EXPECT_LE(level, 4);
}

}  // namespace
}  // namespace herr
