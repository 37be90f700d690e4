// How fast the head moves, against motions whose speed is known.
#include "sessions/streams/head_speed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "sessions/session.h"
#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

constexpr TimeNs kMs = 1'000'000;

Pose turned(double yaw_deg, const glm::dvec3& position = glm::dvec3{0.0}) {
  return {position, glm::angleAxis(glm::radians(yaw_deg), glm::dvec3(0, 1, 0))};
}

double turn_deg_s(const HeadSpeedMeter& meter) {
  return glm::degrees(meter.speed().turn_rad_s);
}

TEST(HeadSpeedTest, OfSteadyMotionIsThatOfTheMotion) {
  // 40 degrees and |(1, 0, -2)| m a second at 100 Hz; after 1 s what smoothing still lacks is exp(-50).
  HeadSpeedMeter meter;
  for (int i = 0; i <= 100; ++i) meter.add(i * 10 * kMs, turned(0.4 * i, glm::dvec3(1, 0, -2) * (0.01 * i)));
  EXPECT_NEAR(turn_deg_s(meter), 40, 1e-9);
  EXPECT_NEAR(meter.speed().move_m_s, std::sqrt(5.0), 1e-9);
}

TEST(HeadSpeedTest, ATurnCountsAtOnceAndItsEndAfterAWhile) {
  HeadSpeedMeter meter;
  TimeNs t = 0;
  double yaw_deg = 0;
  const auto run = [&](int steps, double deg_s) {
    for (int i = 0; i < steps; ++i) meter.add(t += 5 * kMs, turned(yaw_deg += deg_s * 0.005));
  };
  run(100, 0);
  EXPECT_EQ(turn_deg_s(meter), 0);
  run(8, 100);  // 40 ms, two time constants: 1 - exp(-2) of it are there
  EXPECT_NEAR(turn_deg_s(meter), 100 * (1 - std::exp(-2.0)), 0.01);
  run(92, 100);
  run(50, 0);  // 0.25 s, one time constant; the smoothed velocity falls off twelve times as fast and adds
               // less than a delay of two of its own time constants would
  EXPECT_GE(turn_deg_s(meter), 100 * std::exp(-1.0));
  EXPECT_LE(turn_deg_s(meter), 100 * std::exp(-(0.25 - 0.04) / 0.25));
}

TEST(HeadSpeedTest, ATrackersNoiseCancels) {
  // 0.02 degrees to and fro at 1 kHz: steps of 40 degrees a second. A first-order filter leaves of such
  // an alternation (1 - k) / (1 + k) = 2.5 % with k = exp(-1 / 20).
  HeadSpeedMeter meter;
  for (int i = 0; i < 2000; ++i) meter.add(i * kMs, turned(i % 2 == 0 ? 0.02 : 0.0));
  const double k = std::exp(-0.05);
  EXPECT_NEAR(turn_deg_s(meter), 20.0 * (1 - k) / (1 + k), 20.0 * 0.025);
}

TEST(HeadSpeedTest, GapsAndStampsThatDoNotGrowAreNoSpeed) {
  HeadSpeedMeter meter;
  meter.add(0, turned(0));
  meter.add(0, turned(90));
  meter.add(-5 * kMs, turned(180));
  EXPECT_EQ(turn_deg_s(meter), 0);
  meter.add(3600'000 * kMs, turned(170));  // an hour later
  EXPECT_EQ(turn_deg_s(meter), 0);
  for (int i = 1; i <= 20; ++i) meter.add((3600'000 + 10 * i) * kMs, turned(170 + i));
  EXPECT_NEAR(turn_deg_s(meter), 100, 0.01);
  meter.add(7200'000 * kMs, turned(0));
  EXPECT_NEAR(turn_deg_s(meter), 0, 1e-9) << "at rest after a gap";
}

TEST(HeadSpeedTest, DependsOnTheRecordingAndNotOnHowOftenOrHowItIsSampled) {
  test::RecordedFolder folder;
  test::write_good_session(folder);
  const auto speed_at_80_ms = [&](int step_ms, SamplingMode mode) {
    SessionOptions options;
    options.sampling = mode;
    Session session = Session::open(folder.path(), options);
    FrameSample sample;
    for (int t = step_ms; t <= 80; t += step_ms) sample = session.sample(t * kMs);
    return sample.head_speed.move_m_s;
  };
  const double expected = speed_at_80_ms(1, SamplingMode::latest);
  EXPECT_NEAR(expected, 1, 0.02) << "1 cm each 10 ms, but for exp(-80 / 20)";
  for (const SamplingMode mode : {SamplingMode::latest, SamplingMode::predict, SamplingMode::interpolate}) {
    EXPECT_EQ(speed_at_80_ms(80, mode), expected);
    EXPECT_EQ(speed_at_80_ms(16, mode), expected);
  }
}

}  // namespace
}  // namespace herr
