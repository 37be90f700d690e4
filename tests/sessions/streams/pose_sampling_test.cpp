// Sampling of head poses against slow, obvious code and against motions whose truth is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <iomanip>
#include <random>
#include <sstream>

#include "sessions/session.h"
#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using test::kPoseHeader;
using test::RecordedFolder;

constexpr TimeNs kMs = 1'000'000;

struct Recorded {
  TimeNs stamp_ns;
  Pose pose;
};

std::string csv(const std::vector<Recorded>& rows) {
  std::ostringstream text;
  text << kPoseHeader << std::setprecision(17);
  for (const auto& [stamp_ns, pose] : rows) {
    const glm::dquat& q = pose.orientation;
    text << stamp_ns << ',' << pose.position.x << ',' << pose.position.y << ',' << pose.position.z << ','
         << q.x << ',' << q.y << ',' << q.z << ',' << q.w << '\n';
  }
  return text.str();
}

Session open_with(const RecordedFolder& folder, const std::vector<Recorded>& rows, SamplingMode mode,
                  double predict_cap_s = 0.1) {
  write_good_session(folder);
  std::filesystem::remove_all(folder / "gaze");
  folder.write("pose/data.csv", csv(rows));
  SessionOptions options;
  options.sampling = mode;
  options.predict_cap_s = predict_cap_s;
  return Session::open(folder.path(), options);
}

// A head that moves at (1, 0, -2) m/s and turns left at 40 degrees per second.
Pose truth_at(double t_s) {
  return {glm::dvec3(1, 0, -2) * t_s, glm::angleAxis(glm::radians(40.0) * t_s, glm::dvec3(0, 1, 0))};
}

std::vector<Recorded> steady_motion() {
  std::vector<Recorded> rows;
  for (TimeNs t = 0; t <= 200 * kMs; t += 10 * kMs)
    rows.push_back({t, truth_at(static_cast<double>(t) * 1e-9)});
  return rows;
}

// Angle between two orientations; half the chord is exact near 0, where acos is not.
double angle_between(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat turn = a * glm::conjugate(b);
  return 2 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
}

// Ten operations, each within an ulp (2.2e-16) of values below 1.
constexpr double kRounding = 3e-15;

void expect_pose(const Pose& found, const Pose& expected) {
  EXPECT_LT(glm::distance(found.position, expected.position), kRounding);
  EXPECT_LT(angle_between(found.orientation, expected.orientation), kRounding);
  EXPECT_NEAR(glm::length(found.orientation), 1, kRounding);
}

TEST(LatestPose, IsTheNewestSampleThatIsNotLaterAtIrregularTimes) {
  std::mt19937 random(7);
  std::vector<Recorded> rows;
  TimeNs t = 1000 * kMs;
  for (int i = 0; i < 400; ++i) {
    rows.push_back({t, {glm::dvec3(i, 0, 0), {1, 0, 0, 0}}});
    t += kMs + static_cast<TimeNs>(random() % 30'000'000);
  }
  const RecordedFolder folder;
  Session session = open_with(folder, rows, SamplingMode::latest);
  EXPECT_EQ(session.start_ns(), rows.front().stamp_ns);
  EXPECT_EQ(session.end_ns(), rows.back().stamp_ns);
  for (TimeNs at = session.start_ns(); at < session.end_ns() + 50 * kMs;
       at += static_cast<TimeNs>(random() % 40'000'000)) {
    const Recorded* newest = nullptr;
    for (const Recorded& row : rows)
      if (row.stamp_ns <= at) newest = &row;
    const SampledPose head = session.sample(at).head;
    EXPECT_EQ(head.world_from_head.position.x, newest->pose.position.x);
    EXPECT_EQ(head.stamp_ns, newest->stamp_ns);
    EXPECT_EQ(head.age_ns, at - newest->stamp_ns);
    EXPECT_EQ(head.source, at == newest->stamp_ns ? SampleSource::exact : SampleSource::held);
  }
}

TEST(InterpolatedPose, FollowsSteadyMotionExactlyAndHasNoAge) {
  const RecordedFolder folder;
  Session session = open_with(folder, steady_motion(), SamplingMode::interpolate);
  for (TimeNs t = 0; t < 200 * kMs; t += 3 * kMs) {
    const SampledPose head = session.sample(t).head;
    expect_pose(head.world_from_head, truth_at(static_cast<double>(t) * 1e-9));
    EXPECT_EQ(head.source, t % (10 * kMs) == 0 ? SampleSource::exact : SampleSource::interpolated);
    EXPECT_EQ(head.age_ns, t % (10 * kMs) == 0 ? 0 : -1);
  }
  const SampledPose after_end = session.sample(230 * kMs).head;
  EXPECT_EQ(after_end.source, SampleSource::held);
  EXPECT_EQ(after_end.age_ns, 30 * kMs);
}

TEST(InterpolatedPose, TurnsTheShortWayWhateverTheSignOfTheQuaternions) {
  std::vector<Recorded> rows = {{0, truth_at(0)}, {10 * kMs, truth_at(0.01)}};
  rows[1].pose.orientation = -rows[1].pose.orientation;
  const RecordedFolder folder;
  Session session = open_with(folder, rows, SamplingMode::interpolate);
  expect_pose(session.sample(5 * kMs).head.world_from_head, truth_at(0.005));
}

TEST(InterpolatedPose, DoesNotBridgeAPauseOfMoreThanASecond) {
  const RecordedFolder folder;
  Session session =
      open_with(folder, {{0, truth_at(0)}, {1001 * kMs, truth_at(1)}}, SamplingMode::interpolate);
  EXPECT_EQ(session.sample(500 * kMs).head.source, SampleSource::held);
}

TEST(PredictedPose, FollowsSteadyMotionExactly) {
  const RecordedFolder folder;
  Session session = open_with(folder, steady_motion(), SamplingMode::predict);
  EXPECT_EQ(session.sample(5 * kMs).head.source, SampleSource::held) << "one sample has no velocity";
  for (TimeNs t = 10 * kMs; t < 290 * kMs; t += 3 * kMs) {
    const SampledPose head = session.sample(t).head;
    expect_pose(head.world_from_head, truth_at(static_cast<double>(t) * 1e-9));
    const bool at_sample = t % (10 * kMs) == 0 && t <= 200 * kMs;
    EXPECT_EQ(head.source, at_sample ? SampleSource::exact : SampleSource::predicted);
    EXPECT_EQ(head.age_ns, t - std::min<TimeNs>(t / (10 * kMs) * 10 * kMs, 200 * kMs));
  }
}

TEST(PredictedPose, GoesNoFurtherThanTheCap) {
  const RecordedFolder folder;
  Session session = open_with(folder, steady_motion(), SamplingMode::predict, 0.05);
  const SampledPose head = session.sample(3'600'000 * kMs).head;  // an hour after the last sample at 0.2 s
  expect_pose(head.world_from_head, truth_at(0.25));
  EXPECT_EQ(head.age_ns, 3'600'000 * kMs - 200 * kMs) << "the age is not capped";
}

TEST(PredictedPose, TakesNoVelocityFromSamplesTooCloseOrTooFarApart) {
  const RecordedFolder folder;
  Session session = open_with(folder,
                              {{0, truth_at(0)},
                               {10 * kMs, truth_at(0.01)},
                               {10 * kMs + 1, {glm::dvec3(1e8, 0, 0), {1, 0, 0, 0}}},
                               {2000 * kMs, truth_at(0)}},
                              SamplingMode::predict);
  EXPECT_EQ(session.sample(15 * kMs).head.source, SampleSource::held);
  EXPECT_EQ(session.sample(15 * kMs).head.world_from_head.position.x, 1e8);
  EXPECT_EQ(session.sample(2010 * kMs).head.source, SampleSource::held);
}

TEST(Session, RefusesTimeThatRunsBackwardsButNotTheSameTimeAgain) {
  const RecordedFolder folder;
  Session session = open_with(folder, steady_motion(), SamplingMode::latest);
  session.sample(50 * kMs);
  EXPECT_NO_THROW(session.sample(50 * kMs));
  EXPECT_THROW(session.sample(49 * kMs), std::logic_error);
  session.events_until(50 * kMs);
  EXPECT_THROW(session.events_until(49 * kMs), std::logic_error);
}

}  // namespace
}  // namespace herr
