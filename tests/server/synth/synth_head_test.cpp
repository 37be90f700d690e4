// Heads of `herr synth` against the numbers that they are made after.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "server/synth/gaze_targets.h"
#include "server/synth/head_motion.h"

namespace herr {
namespace {

HeadMotion head_of(MotionKind kind, std::uint64_t seed) {
  return HeadMotion({seed, kind, {{0, 1.6, 0}, {2.0, 1.5}}});
}

glm::dvec3 ahead(const Pose& pose) {
  return pose.orientation * glm::dvec3(0, 0, -1);
}

double turning_speed_deg_s(const HeadMotion& head, double time_s) {
  return angle_between_deg(ahead(head.at(time_s)), ahead(head.at(time_s + 0.001))) / 0.001;
}

TEST(HeadMotion, IsTheSameForTheSameSeedAndAnotherForAnother) {
  for (const MotionKind kind :
       {MotionKind::desk, MotionKind::standing, MotionKind::turning, MotionKind::walking}) {
    const HeadMotion a = head_of(kind, 5), b = head_of(kind, 5), c = head_of(kind, 6);
    EXPECT_EQ(a.at(1.25).position, b.at(1.25).position);
    EXPECT_NE(a.at(1.25).position, c.at(1.25).position);
  }
}

TEST(HeadMotion, IsAFunctionOfTimeInWhateverOrderItIsAsked) {
  for (const MotionKind kind : {MotionKind::turning, MotionKind::walking}) {
    const HeadMotion head = head_of(kind, 5);
    const Pose before = head.at(12.5);
    (void)head.at(7000);
    EXPECT_EQ(head.at(12.5).position, before.position);
    EXPECT_EQ(head.at(12.5).orientation, before.orientation);
  }
}

TEST(HeadMotion, AtADeskStaysNearItsPlaceAndMovesSmoothly) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const HeadMotion head = head_of(MotionKind::desk, seed);
    Pose before = head.at(0);
    for (double t = 0.01; t < 10; t += 0.01) {
      const Pose now = head.at(t);
      EXPECT_LT(glm::distance(now.position, glm::dvec3(0, 1.6, 0)), 0.3);
      EXPECT_NEAR(glm::length(now.orientation), 1.0, 1e-12);
      // Sway of 0.2 m at up to 0.6 Hz and steps of 0.015 m at 1.8 Hz: below 2 pi (0.25 * 0.6 + 0.02 * 1.8)
      // = 1.2 m/s.
      EXPECT_LT(glm::distance(now.position, before.position), 0.012);
      // Turns of 8 deg at up to 1.5 Hz: below 2 pi * 8 * 1.5 = 75 deg/s on one axis, 0.75 deg
      // in 10 ms; three axes add.
      EXPECT_LT(angle_between_deg(ahead(now), ahead(before)), 1.2);
      before = now;
    }
  }
}

TEST(HeadMotion, StandingQuietlySwaysByMillimetres) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const HeadMotion head = head_of(MotionKind::standing, seed);
    double sum = 0;
    for (int i = 0; i < 6000; ++i) {
      const double t = 0.01 * i;
      const double away_m = glm::distance(head.at(t).position, glm::dvec3(0, 1.6, 0));
      EXPECT_LE(away_m, 0.0146);  // |0.008, 0.002, 0.012|
      sum += away_m * away_m;
      // 2 pi * 1 Hz * 14.6 mm = 92 mm/s at most, about half of that with waves from 0.1 Hz on.
      EXPECT_LT(glm::distance(head.at(t).position, head.at(t + 0.01).position), 0.00092);
    }
    // Root mean square over a minute, all axes: Winter 1995 has some 5 mm.
    EXPECT_GT(std::sqrt(sum / 6000), 0.002) << seed;
    EXPECT_LT(std::sqrt(sum / 6000), 0.010) << seed;
  }
}

TEST(HeadMotion, HeadTurnsPeakBetweenAHundredAndTwoHundredDegreesASecond) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const HeadMotion head = head_of(MotionKind::turning, seed);
    double fastest = 0, widest_deg = 0;
    for (double t = 0; t < 120; t += 0.005) {
      fastest = std::max(fastest, turning_speed_deg_s(head, t));
      widest_deg = std::max(widest_deg, angle_between_deg(ahead(head.at(t)), {0, 0, -1}));
    }
    // 43 turns: the fastest of them is near the limit. Quiet standing adds 2 pi (1.5 + 1) deg * 1 Hz = 16.
    EXPECT_GT(fastest, 150) << seed;
    EXPECT_LT(fastest, 216) << seed;
    EXPECT_LT(widest_deg, 62 + 2.5) << seed;  // 60 and 15 degrees, and the sway
    EXPECT_GT(widest_deg, 50) << seed;
  }
}

TEST(HeadMotion, WalksAtTheSpeedAndTheStepsOfPeople) {
  const HeadMotion head = head_of(MotionKind::walking, 3);
  const double bob_limit_m = 0.5 * 0.02;
  int steps = 0, fast = 0;
  double fastest = 0, fast_s = 0, highest = 0;
  bool was_up = false;
  for (double t = 0; t < 600; t += 0.01) {
    const glm::dvec3 step = (head.at(t + 0.01).position - head.at(t).position) / 0.01;
    const double along = std::hypot(step.x, step.z);
    fastest = std::max(fastest, glm::length(step));
    const double up = head.at(t).position.y - 1.6;
    highest = std::max(highest, std::abs(up));
    // Steps are counted as rises past half of the bob, while walking at more than 1.1 m/s.
    fast_s += along > 1.1 ? 0.01 : 0;
    fast += along > 1.1 ? 1 : 0;
    if (along > 1.1 && up > bob_limit_m && !was_up) ++steps;
    if (up < 0) was_up = false;
    if (up > bob_limit_m) was_up = true;
  }
  EXPECT_GT(fast, 10000) << "walks a good part of the ten minutes";
  // 1.8 steps a second; a stretch that begins or ends within a step gains or loses one: some 200 stretches of
  // 1-2 s, half a step each way.
  EXPECT_NEAR(steps / fast_s, 1.8, 0.35);
  EXPECT_NEAR(highest, 0.02, 0.0025);  // and up to 2 mm of sway
  // 1.2 m/s; sideways 2 pi * 0.9 * 0.02 = 0.11, up 0.23, sway below 2 pi * 0.6 * 0.028 = 0.11.
  EXPECT_GT(fastest, 1.15);
  EXPECT_LT(fastest, 1.5);
}

TEST(HeadMotion, WalkersTurnAtTheWallsAndNeverTeleport) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const HeadMotion head = head_of(MotionKind::walking, seed);
    for (const double begin_s : {0.0, 3500.0, 86000.0}) {
      for (double t = begin_s; t < begin_s + 120; t += 0.01) {
        const Pose now = head.at(t), next = head.at(t + 0.01);
        // The area is 4 x 3 m; bob and sway are 2 cm each on both axes.
        EXPECT_LE(std::abs(now.position.x), 2.04);
        EXPECT_LE(std::abs(now.position.z), 1.54);
        EXPECT_LT(glm::distance(now.position, next.position), 0.015);
        // 120 deg/s on the spot, 12 deg of looking about at up to 0.6 Hz: 2 pi * 12 * 0.6 = 45, and the nod.
        EXPECT_LT(angle_between_deg(ahead(now), ahead(next)), 2.0);
      }
    }
  }
}

TEST(WalkPath, SpeedIsTheSlopeOfTheWayAndHeadingItsDirection) {
  const WalkPath path(11, {{1, 1.6, -2}, {0.3, 3.0}});
  for (double t = 0.05; t < 900; t += 0.05) {
    const WalkPath::State before = path.at(t - 1e-5), now = path.at(t), after = path.at(t + 1e-5);
    const glm::dvec3 slope = (after.position - before.position) / 2e-5;
    // The second derivative is below 1.5 * 1.2 / 0.8 = 2.3 m/s^2 and continuous but for its own kinks.
    EXPECT_NEAR(glm::length(slope), now.speed_m_s, 1e-4) << t;
    if (now.speed_m_s < 0.01) continue;
    const glm::dvec3 heading{-std::sin(now.heading_rad), 0, -std::cos(now.heading_rad)};
    EXPECT_LT(angle_between_deg(slope, heading), 0.01) << t;
  }
}

TEST(HeadMotion, StillMeansStill) {
  const HeadMotion head = head_of(MotionKind::still, 1);
  EXPECT_EQ(head.at(0).position, glm::dvec3(0, 1.6, 0));
  EXPECT_EQ(head.at(99).position, head.at(0).position);
  EXPECT_EQ(head.at(99).orientation, head.at(0).orientation);
}

}  // namespace
}  // namespace herr
