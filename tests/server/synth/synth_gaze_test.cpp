// Eyes of `herr synth` against the numbers that they are made after.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "server/synth/gaze_motion.h"
#include "server/synth/irregular_events.h"

namespace herr {
namespace {

// One eye in the middle of the head: angles are those of the main sequence.
const std::array<Pose, 2> kCyclops{};

std::array<Pose, 2> two_eyes() {
  std::array<Pose, 2> head_from_eye;
  head_from_eye[0].position = {-0.0315, 0, 0};
  head_from_eye[1].position = {0.0315, 0, 0};
  return head_from_eye;
}

HeadMotion head_of(MotionKind kind, std::uint64_t seed) {
  return HeadMotion({seed, kind, {{0, 1.6, 0}, {2.0, 2.0}}});
}

struct Jump {
  double duration_s = 0, amplitude_deg = 0, peak_deg_s = 0;
  double rest_before_s = 0;
};

// Runs of movement between rests, seen each half millisecond by a head that does not move.
std::vector<Jump> jumps_of(GazeKind kind, double duration_s) {
  constexpr double kStepS = 0.0005;
  const HeadMotion head = head_of(MotionKind::still, 1);
  GazeMotion gaze({9, kind, 0.0}, head);
  std::vector<Jump> jumps;
  glm::dvec3 before = gaze.at(0, kCyclops)[0], from = before;
  double begin_s = 0, rest_s = 0;
  bool moving = false;
  Jump jump;
  for (int i = 1; i * kStepS < duration_s; ++i) {
    const double t = i * kStepS;
    const glm::dvec3 now = gaze.at(t, kCyclops)[0];
    const double moved_deg = angle_between_deg(before, now);
    const bool moves = moved_deg > 1e-9;
    if (moves && !moving) {
      jump = {};
      jump.rest_before_s = t - rest_s;
      begin_s = t - kStepS;
      from = before;
    }
    if (moves) jump.peak_deg_s = std::max(jump.peak_deg_s, moved_deg / kStepS);
    if (!moves && moving) {
      jump.duration_s = t - kStepS - begin_s;
      jump.amplitude_deg = angle_between_deg(from, now);
      jumps.push_back(jump);
      rest_s = t;
    }
    moving = moves;
    before = now;
  }
  return jumps;
}

TEST(GazeMotion, SaccadesFollowTheMainSequence) {
  const std::vector<Jump> jumps = jumps_of(GazeKind::fixations, 300);
  ASSERT_GT(jumps.size(), 700u);
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const Jump& jump : jumps) {
    n += 1;
    x += jump.amplitude_deg;
    y += jump.duration_s;
    xx += jump.amplitude_deg * jump.amplitude_deg;
    xy += jump.amplitude_deg * jump.duration_s;
    if (jump.amplitude_deg < 3) continue;
    // Minimum jerk: the highest speed is 1.875 times the mean; durations from 27 ms on are seen to a
    // millisecond, 4 %.
    EXPECT_NEAR(jump.peak_deg_s / (jump.amplitude_deg / jump.duration_s), 1.875, 0.075) << jump.amplitude_deg;
  }
  // The line of least squares through durations that are seen to half a millisecond or two: 2.2 ms per degree
  // and 21 ms.
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  EXPECT_NEAR(slope, 0.0022, 0.00003);
  EXPECT_NEAR((y - slope * x) / n, 0.021, 0.001);
  // Ten degrees take 43 ms and peak at 1.875 * 10 / 0.043 = 436 deg/s: people have 350-500.
  EXPECT_NEAR(saccade_duration_s(10), 0.043, 1e-12);
}

TEST(GazeMotion, FixationsLastAsLongAsInScenes) {
  const std::vector<Jump> jumps = jumps_of(GazeKind::fixations, 300);
  std::vector<double> rests;
  double sum = 0;
  for (const Jump& jump : jumps) {
    rests.push_back(jump.rest_before_s);
    sum += jump.rest_before_s;
  }
  // Median 0.28 s, mean 0.28 exp(0.35^2 / 2) = 0.298 s, deviation 0.107 s: 850 of
  // them give the mean to 0.004.
  EXPECT_NEAR(sum / static_cast<double>(rests.size()), 0.298, 0.015);
  std::sort(rests.begin(), rests.end());
  EXPECT_NEAR(rests[rests.size() / 2], 0.28, 0.015);
  EXPECT_GE(rests.front(), 0.099);
  EXPECT_LE(rests.back(), 0.802);
}

TEST(GazeMotion, ReadingGoesByWordsAndComesBackForLines) {
  const std::vector<Jump> jumps = jumps_of(GazeKind::reading, 120);
  ASSERT_GT(jumps.size(), 350u);
  double rest_s = 0;
  int words = 0, sweeps = 0;
  for (const Jump& jump : jumps) {
    rest_s += jump.rest_before_s;
    words += jump.amplitude_deg > 1.0 && jump.amplitude_deg < 3.0 ? 1 : 0;
    sweeps += jump.amplitude_deg > 12.0 ? 1 : 0;
  }
  const auto count = static_cast<double>(jumps.size());
  EXPECT_NEAR(rest_s / count, 0.239, 0.015);  // 0.225 exp(0.35^2 / 2)
  // A line of 0.2 m has 9.5 words of 21 mm; one in ten steps goes back one: some 12 fixations for each line.
  EXPECT_NEAR(sweeps / count, 1.0 / 12, 0.03);
  EXPECT_GT(words / count, 0.85);
}

TEST(GazeMotion, PursuesTargetsSlowerThanThirtyDegreesASecondAndCatchesUp) {
  const HeadMotion head = head_of(MotionKind::still, 1);
  GazeMotion gaze({5, GazeKind::pursuit, 0.0}, head);
  int smooth = 0, catch_ups = 0;
  glm::dvec3 before = gaze.at(0, kCyclops)[0], rest = before;
  std::int64_t saccades = 0;
  for (double t = 0.001; t < 120; t += 0.001) {
    const glm::dvec3 now = gaze.at(t, kCyclops)[0];
    const double speed_deg_s = angle_between_deg(before, now) / 0.001;
    const GazeTarget& target = gaze.target();
    if (t > target.start_s + 0.002 && t < target.leave_s) {
      // 5-30 degrees a second times 0.9; less where the straight way takes the target to the side, by
      // cos^2 of up to 45 degrees.
      EXPECT_GT(speed_deg_s, 2.2) << t;
      EXPECT_LT(speed_deg_s, 27.01) << t;
      ++smooth;
      if (gaze.saccades() > saccades) {
        catch_ups += angle_between_deg(rest, now) < 6 ? 1 : 0;
        saccades = gaze.saccades();
      }
      rest = now;
    }
    before = now;
  }
  EXPECT_GT(smooth, 80000) << "most of the time the eyes follow";
  // The eyes lose a tenth of 17 deg/s on average and let it grow to 1.5 degrees: about one each second, less
  // what new targets take.
  EXPECT_GT(catch_ups, 30);
  EXPECT_LT(catch_ups, 240);
}

TEST(GazeMotion, EyesStayOnTheirTargetWhileTheHeadTurns) {
  int during_turns = 0;
  for (const MotionKind kind : {MotionKind::turning, MotionKind::walking, MotionKind::desk}) {
    const HeadMotion head = head_of(kind, 2);
    GazeMotion gaze({2, GazeKind::fixations, 0.0}, head);
    for (double t = 0; t < 60; t += 0.004) {
      const Pose pose = head.at(t);
      const glm::dvec3 world = pose.orientation * gaze.at(t, kCyclops)[0];
      const GazeTarget& target = gaze.target();
      if (t < target.start_s || t > target.leave_s) continue;
      EXPECT_LT(angle_between_deg(world, target.point - pose.position), 1e-6);
      const glm::dvec3 ahead{0, 0, -1};
      const double turned_deg =
          angle_between_deg(pose.orientation * ahead, head.at(t + 0.001).orientation * ahead);
      during_turns += turned_deg > 0.08 ? 1 : 0;
    }
  }
  EXPECT_GT(during_turns, 500) << "some two seconds at more than 80 deg/s";
}

TEST(GazeMotion, NoEyeTurnsFurtherThanATrackerSees) {
  for (const MotionKind motion : {MotionKind::turning, MotionKind::walking, MotionKind::desk}) {
    for (const GazeKind kind : {GazeKind::fixations, GazeKind::pursuit, GazeKind::reading, GazeKind::still}) {
      SCOPED_TRACE(motion_names()[static_cast<std::size_t>(motion)] + ", " +
                   gaze_names()[static_cast<std::size_t>(kind)]);
      const HeadMotion head = head_of(motion, 4);
      GazeMotion gaze({4, kind, 0.2}, head);
      for (double t = 0; t < 120; t += 1.0 / 90)
        for (const glm::dvec3& direction : gaze.at(t, two_eyes())) {
          EXPECT_NEAR(glm::length(direction), 1.0, 1e-12);
          // Fixations end at 26 degrees off axis; a head of 200 deg/s turns 10 degrees in the shortest
          // fixation and as many in a saccade; eyes see a page a few degrees from where the head sees it.
          EXPECT_LT(angle_between_deg(direction, {0, 0, -1}), 56) << t;
        }
    }
  }
}

TEST(GazeMotion, TheEyesConverge) {
  const HeadMotion head = head_of(MotionKind::desk, 4);
  GazeMotion gaze({4, GazeKind::fixations, 0.0}, head);
  for (double t = 0; t < 20.0; t += 0.01) {
    const std::array<glm::dvec3, 2> eyes = gaze.at(t, two_eyes());
    const double vergence_deg = angle_between_deg(eyes[0], eyes[1]);
    // 63 mm apart, looking at a point: 3.6 deg at 1 m, 0.7 deg at 5 m; sway and cosines widen that a little.
    EXPECT_GT(vergence_deg, 0.4);
    EXPECT_LT(vergence_deg, 6.0);
    EXPECT_LT(eyes[1].x, eyes[0].x);
  }
}

TEST(GazeMotion, NoiseHasTheDeviationThatWasAskedFor) {
  const HeadMotion head = head_of(MotionKind::still, 1);
  GazeMotion gaze({1, GazeKind::still, 0.2}, head);
  double sum = 0;
  constexpr int kRows = 20000;
  for (int i = 0; i < kRows; ++i) {
    const glm::dvec3 direction = gaze.at(i / 120.0, kCyclops)[0];
    sum += direction.x * direction.x;
  }
  // The deviation of 20,000 draws is good to 1 / sqrt(40,000) = 0.5 %.
  EXPECT_NEAR(glm::degrees(std::sqrt(sum / kRows)), 0.2, 0.004);
}

TEST(GazeMotion, JumpsWithEveryRowWhenAskedTo) {
  const HeadMotion head = head_of(MotionKind::still, 1);
  GazeMotion gaze({1, GazeKind::jumping, 0.0}, head);
  double sum_deg = 0;
  glm::dvec3 before = gaze.at(0, kCyclops)[0];
  for (int i = 1; i <= 1000; ++i) {
    const glm::dvec3 now = gaze.at(i / 120.0, kCyclops)[0];
    sum_deg += angle_between_deg(before, now);
    EXPECT_LT(angle_between_deg(now, {0, 0, -1}), 55) << "acos(cos^2 40 deg) = 54.1";
    before = now;
  }
  EXPECT_GT(sum_deg / 1000, 30) << "two points of a square of 80 degrees are 42 apart on average";
}

TEST(GazeMotion, DiffersBetweenSeeds) {
  const HeadMotion head = head_of(MotionKind::still, 1);
  GazeMotion a({1, GazeKind::fixations, 0.0}, head), b({1, GazeKind::fixations, 0.0}, head),
      c({2, GazeKind::fixations, 0.0}, head);
  const glm::dvec3 direction = a.at(3, kCyclops)[0];
  EXPECT_EQ(direction, b.at(3, kCyclops)[0]);
  EXPECT_NE(direction, c.at(3, kCyclops)[0]);
}

TEST(Blinks, ComeAtTheirRateAndLastAsLongAsBlinks) {
  IrregularEvents lids = blinks(3, 15);
  double closed_s = 0, lowest = 1;
  for (int i = 0; i < 3600 * 200; ++i) {
    const double openness = lid_openness(lids.share_at(i / 200.0));
    ASSERT_GE(openness, 0.0);
    ASSERT_LE(openness, 1.0);
    lowest = std::min(lowest, openness);
    closed_s += openness < 1 ? 0.005 : 0;
  }
  EXPECT_EQ(lowest, 0);
  // 900 in an hour; intervals of 4 s with an exponential part of 3.5 s: the count's deviation is
  // sqrt(900) * 3.5 / 4 = 26, three of them are 79.
  EXPECT_NEAR(static_cast<double>(lids.count()), 900, 79);
  // The mean of a log-uniform length from 0.15 to 0.3 s is 0.15 / ln 2 = 0.216 s.
  EXPECT_NEAR(closed_s / static_cast<double>(lids.count()), 0.216, 0.01);
}

TEST(Hitches, AreGapsOfFortyToThreeHundredAndFiftyMilliseconds) {
  IrregularEvents pauses = hitches(3, 30);
  int rows = 0;
  double last_s = 0;
  for (int i = 0; i < 600 * 1000; ++i) {
    const double t = i / 1000.0;
    if (pauses.share_at(t)) continue;
    const double gap_s = t - last_s;
    if (gap_s > 0.0015) {
      EXPECT_GT(t, 1.0);
      EXPECT_GT(gap_s, 0.040 - 0.001);
      EXPECT_LT(gap_s, 0.350 + 0.002);
    }
    last_s = t;
    ++rows;
  }
  // 300 in ten minutes; intervals of 2 s of which 1.66 s are exponential: deviation sqrt(300) * 0.83 = 14.
  EXPECT_NEAR(static_cast<double>(pauses.count()), 300, 43);
  // Mean length 0.31 / ln(350 / 40) = 0.143 s.
  EXPECT_NEAR(600 - rows / 1000.0, 300 * 0.143, 8);
}

TEST(IrregularEvents, AreNoneAtARateOfZero) {
  IrregularEvents lids = blinks(1, 0);
  for (int i = 0; i < 10000; ++i) ASSERT_FALSE(lids.share_at(i * 0.1));
  EXPECT_EQ(lids.count(), 0);
}

}  // namespace
}  // namespace herr
