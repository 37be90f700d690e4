// Gaze: what is held, for how long, how it is let go, and where each eye aims.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "sessions/session.h"
#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using test::gaze_row;
using test::kGazeHeader;
using test::RecordedFolder;

constexpr TimeNs kMs = 1'000'000;

Session open_with(const RecordedFolder& folder, const std::string& rows, const std::string& kind = "per_eye",
                  const std::string& fields = "", SamplingMode mode = SamplingMode::latest) {
  write_good_session(folder);
  folder.write("session.json", test::header_json(fields, kind));
  folder.write("gaze/data.csv", kGazeHeader + rows);
  SessionOptions options;
  options.sampling = mode;
  return Session::open(folder.path(), options);
}

// Angle to the right of straight ahead in the horizontal plane.
double right_deg(const glm::dvec3& direction) {
  return glm::degrees(std::atan2(direction.x, -direction.z));
}

// sin, cos and atan2 of angles below a radian, in degrees: 57 * a few ulps.
constexpr double kRoundingDeg = 1e-13;

TEST(Gaze, IsTheNewestValidRow) {
  const RecordedFolder folder;
  Session session =
      open_with(folder, gaze_row(0, 10, true, 12, true) + gaze_row(10 * kMs, 20, true, 22, true));
  const SampledGaze first = session.sample(9 * kMs).gaze;
  EXPECT_NEAR(right_deg(first.head_direction[0]), 10, kRoundingDeg);
  EXPECT_NEAR(right_deg(first.head_direction[1]), 12, kRoundingDeg);
  EXPECT_EQ(first.source[0], SampleSource::held);
  EXPECT_EQ(first.age_ns, 9 * kMs);
  const SampledGaze second = session.sample(10 * kMs).gaze;
  EXPECT_NEAR(right_deg(second.head_direction[0]), 20, kRoundingDeg);
  EXPECT_EQ(second.source[1], SampleSource::exact);
  EXPECT_EQ(second.age_ns, 0);
}

TEST(Gaze, BeforeAnyRowOrWithoutAStreamIsStraightAhead) {
  const RecordedFolder folder;
  Session session = open_with(folder, gaze_row(50 * kMs, 10, true, 10, true));
  const SampledGaze gaze = session.sample(10 * kMs).gaze;
  EXPECT_EQ(gaze.head_direction[0], glm::dvec3(0, 0, -1));
  EXPECT_EQ(gaze.source[0], SampleSource::centred);
  EXPECT_EQ(gaze.age_ns, -1);
  std::filesystem::remove_all(folder / "gaze");
  Session without = Session::open(folder.path());
  EXPECT_EQ(without.sample(0).gaze.source[1], SampleSource::centred);
  EXPECT_EQ(without.findings().warnings.size(), 1u);
}

// 30 degrees at 0, then blind: 30 until 600 ms, then 30 exp(-(t - 0.6 s) / 0.15 s).
double lost_gaze_deg(TimeNs t_ns) {
  const double loose_s = static_cast<double>(t_ns - 600 * kMs) * 1e-9;
  return loose_s <= 0 ? 30 : 30 * std::exp(-loose_s / 0.15);
}

TEST(LostGaze, IsHeldFor600MillisecondsAndThenGlidesToTheCentre) {
  std::string rows = gaze_row(0, 30, true, 30, true);
  for (int i = 1; i < 300; ++i) rows += gaze_row(i * 10 * kMs, 0, false, 0, false);
  const RecordedFolder folder;
  Session session = open_with(folder, rows);
  double before_deg = 30;
  for (TimeNs t = 0; t < 2900 * kMs; t += kMs) {
    const SampledGaze gaze = session.sample(t).gaze;
    const double deg = right_deg(gaze.head_direction[0]);
    EXPECT_NEAR(deg, lost_gaze_deg(t), kRoundingDeg) << t;
    // Continuous: the steepest slope is 30 degrees / 0.15 s = 0.2 degrees a millisecond, at
    // the start of the glide.
    EXPECT_LE(std::abs(deg - before_deg), 0.2 + kRoundingDeg) << t;
    before_deg = deg;
    const SampleSource expected = t == 0           ? SampleSource::exact
                                  : t <= 600 * kMs ? SampleSource::held
                                  : t < 2100 * kMs ? SampleSource::gliding
                                                   : SampleSource::centred;
    EXPECT_EQ(gaze.source[0], expected) << t;
    EXPECT_EQ(gaze.age_ns, expected == SampleSource::centred ? -1 : t) << t;
  }
}

TEST(LostGaze, DoesNotDependOnHowOftenItIsAskedFor) {
  const RecordedFolder folder;
  const std::string rows = gaze_row(0, 30, true, 30, true);  // the stream just ends: that is a loss as well
  Session often = open_with(folder, rows);
  for (TimeNs t = 0; t < 900 * kMs; t += 7 * kMs) often.sample(t);
  Session once = Session::open(folder.path());
  EXPECT_EQ(often.sample(900 * kMs).gaze.head_direction[0], once.sample(900 * kMs).gaze.head_direction[0]);
  const glm::dvec3 hours_later = once.sample(10'000'000 * kMs).gaze.head_direction[0];
  EXPECT_EQ(hours_later, glm::dvec3(0, 0, -1));
}

TEST(Gaze, MoreThan60DegreesOffAxisCountsAsLost) {
  const RecordedFolder folder;
  Session session =
      open_with(folder, gaze_row(0, 59.9, true, -59.9, true) + gaze_row(10 * kMs, 60.1, true, 170, true));
  const SampledGaze gaze = session.sample(20 * kMs).gaze;
  EXPECT_NEAR(right_deg(gaze.head_direction[0]), 59.9, kRoundingDeg);
  EXPECT_NEAR(right_deg(gaze.head_direction[1]), -59.9, kRoundingDeg);
  EXPECT_EQ(gaze.age_ns, 20 * kMs);
}

TEST(OneLostEye, FollowsTheOther) {
  const RecordedFolder folder;
  Session session = open_with(folder, gaze_row(0, 5, true, 7, true) + gaze_row(10 * kMs, 0, false, 20, true) +
                                          gaze_row(20 * kMs, 0, false, 0, false));
  EXPECT_NEAR(right_deg(session.sample(0).gaze.head_direction[0]), 5, kRoundingDeg);
  const SampledGaze gaze = session.sample(10 * kMs).gaze;
  EXPECT_NEAR(right_deg(gaze.head_direction[0]), 20, kRoundingDeg);
  EXPECT_EQ(gaze.source[0], SampleSource::held) << "it was not measured for this eye";
  EXPECT_EQ(gaze.source[1], SampleSource::exact);
  EXPECT_NEAR(right_deg(session.sample(25 * kMs).gaze.head_direction[0]), 20, kRoundingDeg)
      << "both lost: held";
}

TEST(CombinedGaze, AimsEachEyeAtThePointOnTheRay) {
  const RecordedFolder folder;
  Session session = open_with(folder, gaze_row(0, 20, true, 20, true), "combined", "\"vergence_m\": 0.5");
  const SampledGaze gaze = session.sample(0).gaze;
  // The point lies 0.5 m along 20 degrees to the right: (0.5 sin 20, 0, -0.5 cos 20);
  // the eyes at x = -+0.0315.
  const double x = 0.5 * std::sin(glm::radians(20.0)), z = 0.5 * std::cos(glm::radians(20.0));
  EXPECT_NEAR(right_deg(gaze.head_direction[0]), glm::degrees(std::atan2(x + 0.0315, z)), kRoundingDeg);
  EXPECT_NEAR(right_deg(gaze.head_direction[1]), glm::degrees(std::atan2(x - 0.0315, z)), kRoundingDeg);
  // Their lines meet in that point: the eyes converge by about 2 atan(0.0315 / 0.5) cos 20 = 6.8 degrees.
  EXPECT_NEAR(right_deg(gaze.head_direction[0]) - right_deg(gaze.head_direction[1]), 6.8, 0.1);
  EXPECT_NEAR(glm::length(gaze.head_direction[0]), 1, 1e-15);
}

TEST(CombinedGaze, WithoutAVergenceDistanceIsParallel) {
  const RecordedFolder folder;
  Session session = open_with(folder, gaze_row(0, 20, true, 20, true), "combined");
  const SampledGaze gaze = session.sample(0).gaze;
  EXPECT_EQ(gaze.head_direction[0], gaze.head_direction[1]);
}

TEST(CombinedGaze, IsOneRayWhicheverPupilWasSeen) {
  const RecordedFolder folder;
  for (const SamplingMode mode : {SamplingMode::latest, SamplingMode::interpolate}) {
    Session session =
        open_with(folder, gaze_row(0, 20, true, 0, false) + gaze_row(10 * kMs, 0, false, 30, true),
                  "combined", "", mode);
    for (const TimeNs t_ns : {0 * kMs, 4 * kMs, 10 * kMs}) {
      const SampledGaze gaze = session.sample(t_ns).gaze;
      EXPECT_EQ(gaze.head_direction[0], gaze.head_direction[1]);
      EXPECT_EQ(gaze.source[0], gaze.source[1]);
      // Interpolated, 4 of 10 ms are 4 degrees.
      const double expected = t_ns == 10 * kMs ? 30 : mode == SamplingMode::latest || t_ns == 0 ? 20 : 24;
      EXPECT_NEAR(right_deg(gaze.head_direction[0]), expected, kRoundingDeg);
    }
  }
}

TEST(InterpolatedGaze, TurnsEvenlyBetweenNeighboursAndBridgesNoLoss) {
  const RecordedFolder folder;
  Session session =
      open_with(folder,
                gaze_row(0, 10, true, 10, true) + gaze_row(10 * kMs, 20, true, 20, true) +
                    gaze_row(20 * kMs, 0, false, 0, false) + gaze_row(30 * kMs, 40, true, 40, true),
                "per_eye", "", SamplingMode::interpolate);
  const SampledGaze between = session.sample(4 * kMs).gaze;
  EXPECT_NEAR(right_deg(between.head_direction[0]), 14, kRoundingDeg);
  EXPECT_EQ(between.source[0], SampleSource::interpolated);
  EXPECT_EQ(between.age_ns, -1);
  EXPECT_NEAR(right_deg(session.sample(15 * kMs).gaze.head_direction[0]), 20, kRoundingDeg);
  EXPECT_NEAR(right_deg(session.sample(25 * kMs).gaze.head_direction[0]), 20, kRoundingDeg);
}

}  // namespace
}  // namespace herr
