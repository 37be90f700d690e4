#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "server/synth/gaze_motion.h"
#include "server/synth/head_motion.h"

namespace herr {
namespace {

std::array<Pose, 2> eyes() {
  std::array<Pose, 2> head_from_eye;
  head_from_eye[0].position = {-0.0315, 0, 0};
  head_from_eye[1].position = {0.0315, 0, 0};
  return head_from_eye;
}

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

TEST(HeadMotion, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const HeadMotion a(5), b(5), c(6);
  EXPECT_EQ(a.at(1.25).position, b.at(1.25).position);
  EXPECT_NE(a.at(1.25).position, c.at(1.25).position);
}

TEST(HeadMotion, StaysNearItsPlaceAndMovesSmoothly) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const HeadMotion head(seed);
    Pose before = head.at(0);
    for (double t = 0.01; t < 10; t += 0.01) {
      const Pose now = head.at(t);
      EXPECT_LT(glm::distance(now.position, glm::dvec3(0, 1.5, 3.7)), 0.3);
      EXPECT_NEAR(glm::length(now.orientation), 1.0, 1e-12);
      // Sway of 0.2 m at up to 0.6 Hz and steps of 0.015 m at 1.8 Hz: below 2 pi (0.25 * 0.6 + 0.02 * 1.8)
      // = 1.2 m/s.
      EXPECT_LT(glm::distance(now.position, before.position), 0.012);
      // Turns of 8 deg at up to 1.5 Hz: below 2 pi * 8 * 1.5 = 75 deg/s on one axis, 0.75 deg in 10 ms; three
      // axes add.
      const glm::dvec3 ahead = now.orientation * glm::dvec3(0, 0, -1);
      EXPECT_LT(angle_deg(ahead, before.orientation * glm::dvec3(0, 0, -1)), 1.2);
      before = now;
    }
  }
}

TEST(GazeMotion, SaccadesLastAsLongAsTheMainSequenceSays) {
  EXPECT_NEAR(saccade_duration_s(10), 0.043, 1e-12);  // 21 ms + 2.2 ms/deg * 10 deg
}

TEST(GazeMotion, FixatesMostOfTheTimeAndJumpsInBetween) {
  const HeadMotion head(3);
  const GazeMotion gaze(3, 20.0, head);
  int fixating = 0, jumping = 0, total = 0;
  for (double t = 0; t < 20.0; t += 0.005) {
    // In world space a fixation holds still while the head moves.
    const auto world = [&](double time) {
      return head.at(time).orientation * gaze.at(time, eyes()).head_direction[0];
    };
    const double speed_deg_s = angle_deg(world(t), world(t + 0.001)) / 0.001;
    ++total;
    // The head's own motion of 1 m/s at 1 m is up to 57 deg/s; saccades of 10 deg peak at some 400 deg/s.
    fixating += speed_deg_s < 60 ? 1 : 0;
    jumping += speed_deg_s > 100 ? 1 : 0;
  }
  // 200-500 ms of fixation to 21-110 ms of saccade.
  EXPECT_GT(fixating, 0.70 * total);
  EXPECT_GT(jumping, 0.04 * total);
}

TEST(GazeMotion, DirectionsAreUnitAndTheEyesConverge) {
  const HeadMotion head(4);
  const GazeMotion gaze(4, 5.0, head);
  for (double t = 0; t < 5.0; t += 0.01) {
    const GazeMotion::Sample sample = gaze.at(t, eyes());
    for (const auto& direction : sample.head_direction) EXPECT_NEAR(glm::length(direction), 1.0, 1e-12);
    const double vergence_deg = angle_deg(sample.head_direction[0], sample.head_direction[1]);
    // 63 mm apart, looking at a point: 3.6 deg at 1 m, 0.7 deg at 5 m; sway and cosines widen that a little.
    EXPECT_GT(vergence_deg, 0.4);
    EXPECT_LT(vergence_deg, 6.0);
    EXPECT_LT(sample.head_direction[1].x, sample.head_direction[0].x);
  }
}

TEST(GazeMotion, BlinksOnceInTwoSeconds) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const HeadMotion head(seed);
    const GazeMotion gaze(seed, 2.0, head);
    int blinks = 0, invalid = 0;
    bool before = true;
    for (int i = 0; i < 240; ++i) {
      const bool valid = gaze.at(i / 120.0, eyes()).valid;
      blinks += before && !valid ? 1 : 0;
      invalid += valid ? 0 : 1;
      before = valid;
    }
    EXPECT_EQ(blinks, 1) << seed;
    EXPECT_NEAR(invalid, 18, 1) << seed;  // 0.15 s at 120 Hz
  }
}

}  // namespace
}  // namespace herr
