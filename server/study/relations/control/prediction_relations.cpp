// Heads that turn fast and eyes that jump, between samples that are close together or far apart.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "server/study/relations/recording_folder.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_case.h"
#include "server/study/relations/relation_groups.h"
#include "server/text/number_text.h"
#include "sessions/record/session_recorder.h"
#include "sessions/session.h"
#include "sessions/streams/gaze_sampler.h"
#include "sessions/streams/head_speed.h"
#include "sessions/streams/pose_sampler.h"

namespace herr {
namespace {

constexpr TimeNs kMs_ns = 1'000'000, kSecond_ns = 1'000'000'000;
constexpr std::int64_t kTurn_deg_s = 2000;
constexpr double kSpeed_m_s = 3;       // of the head, along x
constexpr double kRounding = 0x1p-53;  // of a double

void write_turn_header(const RelationCase& subject, SessionRecorder& recorder) {
  SessionHeader header;
  header.name = "steady turn";
  header.profile = subject.profile;
  recorder.write_header(header);
}

// The head turns about the world's vertical and moves along x, both steadily, from where the case has it.
struct SteadyHead {
  Pose start;

  // Angles are whole numbers of nanodegrees: no rounding grows with time.
  Pose turned(TimeNs t_ns, double further_deg) const {
    const auto whole_deg = static_cast<double>(kTurn_deg_s * t_ns % (360 * kSecond_ns)) * 1e-9;
    const glm::dquat turn = glm::angleAxis(glm::radians(whole_deg + further_deg), glm::dvec3(0, 1, 0));
    return {start.position, turn * start.orientation};
  }
  Pose at(TimeNs t_ns) const {
    Pose pose = turned(t_ns, 0);
    pose.position.x += kSpeed_m_s * static_cast<double>(t_ns) * kSecondsPerNs;
    return pose;
  }
  // Where it is taken to be `age_ns` after a sample, of samples `step_ns` apart: turning on by what is the
  // short way between two samples.
  Pose predicted(TimeNs sample_ns, TimeNs age_ns, TimeNs step_ns) const {
    if (step_ns > kMaxPoseGapNs) return at(sample_ns);
    const double cap_s = SessionOptions{}.predict_cap_s;
    const double horizon_s = std::min(static_cast<double>(age_ns) * kSecondsPerNs, cap_s);
    const auto seen_deg = static_cast<double>(kTurn_deg_s * step_ns % (360 * kSecond_ns)) * 1e-9;
    const double short_deg = seen_deg > 180 ? seen_deg - 360 : seen_deg;
    Pose pose = turned(sample_ns, short_deg * horizon_s / (static_cast<double>(step_ns) * kSecondsPerNs));
    pose.position.x += kSpeed_m_s * (static_cast<double>(sample_ns) * kSecondsPerNs + horizon_s);
    return pose;
  }
};

double turn_between(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat turn = a * glm::conjugate(b);
  return 2 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
}

// In radians; of the head's place as a share of its distance; of the quaternion's length.
double pose_error(const Pose& found, const Pose& wanted) {
  return std::max({turn_between(found.orientation, wanted.orientation),
                   glm::distance(found.position, wanted.position) / (1 + glm::length(wanted.position)),
                   std::abs(glm::length(found.orientation) - 1)});
}

std::vector<TimeNs> ages(TimeNs step_ns, bool last) {
  std::vector<TimeNs> out{0, 1, step_ns / 3, step_ns / 2, step_ns - 1};
  for (const TimeNs age : {50 * kMs_ns, 100 * kMs_ns, 101 * kMs_ns, kSecond_ns, 3600 * kSecond_ns})
    out.push_back(age);
  std::sort(out.begin(), out.end());
  if (!last) out.erase(std::lower_bound(out.begin(), out.end(), step_ns), out.end());
  return out;
}

void measure_steady_turn(const RelationCase& subject, TimeNs step_ns, RelationLog& log) {
  constexpr int kSamples = 12;
  const double step_s = static_cast<double>(step_ns) * kSecondsPerNs;
  const std::string apart = step_s < 1 ? shortest_text(step_s * 1000) + " ms" : shortest_text(step_s) + " s";
  const bool too_far = step_ns > kMaxPoseGapNs, half_turn = 180 * kSecond_ns < kTurn_deg_s * step_ns;
  Relation relation;
  relation.name = "prediction at 2,000 degrees/s, every " + apart;
  relation.holds = too_far ? "the head is held: samples more than a second apart have no velocity"
                   : half_turn
                       ? "the exact solution of the short way between two samples, held from the cap on: "
                         "their turn of more than a half is taken for a smaller one the other way"
                       : "the exact solution q exp(omega dt), held from the cap of 0.1 s on";
  relation.unit = "radians, or share of distance";
  relation.bound = 48 * kRounding * (1 + SessionOptions{}.predict_cap_s / step_s);
  relation.bound_from =
      "both samples are off by 16 roundings (2^-53) of their parts, and their turn is prolonged so many "
      "times";

  const SteadyHead head{subject.sample.head.world_from_head};
  const RecordingFolder folder;
  SessionRecorder recorder(folder.path());
  write_turn_header(subject, recorder);
  for (int i = 0; i < kSamples; ++i) recorder.add_pose({i * step_ns, head.at(i * step_ns)});
  recorder.flush();
  SessionOptions options;
  options.sampling = SamplingMode::predict;
  Session session = Session::open(folder.path(), options);
  double worst = 0;
  std::string where;
  for (int i = 1; i < kSamples; ++i) {
    for (const TimeNs age_ns : ages(step_ns, i == kSamples - 1)) {
      const Pose found = session.sample(i * step_ns + age_ns).head.world_from_head;
      const double error = pose_error(found, head.predicted(i * step_ns, age_ns, step_ns));
      if (error <= worst) continue;
      worst = error;
      where = shortest_text(static_cast<double>(age_ns) * 1e-6) + " ms after sample " + std::to_string(i);
    }
  }
  log.measured(relation, worst, where);
}

void measure_head_speed(const RelationCase& subject, RelationLog& log) {
  constexpr TimeNs kSpan = 80 * kMs_ns;  // a turn of 160 degrees
  Relation relation;
  relation.name = "speed of the head does not depend on the step";
  relation.holds = "80 ms of a turn of 2,000 degrees/s make the same smoothed speed from 1 sample, 8 or 80";
  relation.unit = "relative error";
  relation.bound = 32 * kRounding / glm::radians(2.0) + 80 * 4 * kRounding;
  relation.bound_from =
      "velocities from samples 2 degrees apart are off by 32 roundings (2^-53); 80 steps round 4 times each";
  const SteadyHead head{subject.sample.head.world_from_head};
  const double wanted =
      glm::radians(double{kTurn_deg_s}) *
      -std::expm1(-static_cast<double>(kSpan) * kSecondsPerNs / HeadSpeedMeter::kSmoothing_s);
  double worst = 0;
  for (const int steps : {1, 8, 80}) {
    HeadSpeedMeter meter;
    for (int i = 0; i <= steps; ++i) meter.add(i * (kSpan / steps), head.at(i * (kSpan / steps)));
    worst = std::max(worst, std::abs(meter.speed().turn_rad_s - wanted) / wanted);
  }
  log.measured(relation, worst);
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Eyes that go to and fro between 50 degrees left and right at 2,000 degrees/s, and are then lost.
glm::dvec3 jumping_gaze(int sample) {
  const int place = sample % 10, fives = place <= 5 ? place : 10 - place;
  const double angle = glm::radians(20.0 * fives - 50);
  return {std::sin(angle), 0, -std::cos(angle)};
}

glm::dvec3 lost_gaze(const glm::dvec3& seen, TimeNs age_ns) {
  if (age_ns <= kGazeHoldNs) return seen;
  const double loose_s = static_cast<double>(age_ns - kGazeHoldNs) * kSecondsPerNs;
  const double angle = std::atan2(seen.x, -seen.z) * std::exp(-loose_s / kGazeGlideTauS);
  return {std::sin(angle), 0, -std::cos(angle)};
}

void measure_gaze_jumps(const RelationCase& subject, RelationLog& log) {
  constexpr TimeNs kGazeStep = 10 * kMs_ns, kLast = 8 * kGazeStep;
  Relation relation;
  relation.name = "gaze that jumps at 2,000 degrees/s, then is lost";
  relation.holds =
      "gaze is never predicted; lost, it is held for 0.6 s, then its angle falls by exp(-dt / 0.15 s), at "
      "any "
      "frame rate";
  relation.unit = "radians";
  relation.bound = 32 * kRounding;
  relation.bound_from = "an arc tangent, an exponential, sine and cosine of angles below 1, normalised";
  const RecordingFolder folder;
  SessionRecorder recorder(folder.path());
  write_turn_header(subject, recorder);
  for (int i = 0; i <= 8; ++i) {
    recorder.add_pose({i * kGazeStep, subject.sample.head.world_from_head});
    recorder.add_gaze({i * kGazeStep, {jumping_gaze(i), jumping_gaze(i)}, {true, true}});
  }
  recorder.flush();
  double worst = 0;
  SessionOptions options;
  options.sampling = SamplingMode::predict;
  for (const TimeNs frame_ns : {kMs_ns, 7 * kMs_ns, 900 * kMs_ns, kSecond_ns}) {
    Session session = Session::open(folder.path(), options);
    for (TimeNs t = 0; t < 3 * kSecond_ns; t += frame_ns) {
      const glm::dvec3 seen = jumping_gaze(static_cast<int>(std::min(t, kLast) / kGazeStep));
      const glm::dvec3 wanted = lost_gaze(seen, t - std::min(t, kLast) / kGazeStep * kGazeStep);
      worst = std::max(worst, angle_between(session.sample(t).gaze.head_direction[0], wanted));
    }
  }
  log.measured(relation, worst);
}

}  // namespace

void measure_prediction(const RelationCase& subject, RelationLog& log) {
  for (const TimeNs step_ns : {kMs_ns, 10 * kMs_ns, 100 * kMs_ns, kSecond_ns, 10 * kSecond_ns}) {
    measure_steady_turn(subject, step_ns, log);
  }
  measure_head_speed(subject, log);
  measure_gaze_jumps(subject, log);
}

}  // namespace herr
