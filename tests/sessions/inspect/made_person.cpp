#include "tests/sessions/inspect/made_person.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <random>

namespace herr::test {
namespace {

constexpr double kTwoPi = 6.283185307179586;

// Uniform in [low, high), the same everywhere.
double uniform(std::mt19937& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

class Head {
 public:
  explicit Head(std::mt19937& random) {
    for (double& phase : phases_) phase = uniform(random, 0, kTwoPi);
  }
  // Turns at up to 80 degrees a second sideways and 40 up and down.
  Pose at(double t) const {
    const auto wave = [&](std::size_t i, double hz) { return std::sin(kTwoPi * hz * t + phases_[i]); };
    const double yaw = glm::radians(35 * wave(0, 0.21) + 9 * wave(1, 0.57));
    const double pitch = glm::radians(-10 + 12 * wave(2, 0.27) + 4 * wave(3, 0.73));
    const double roll = glm::radians(2 * wave(4, 0.4));
    Pose pose;
    pose.position = {0.05 * wave(5, 0.33), 1.6 + 0.02 * wave(6, 0.9), 0.08 * wave(7, 0.25)};
    pose.orientation = glm::angleAxis(yaw, glm::dvec3(0, 1, 0)) * glm::angleAxis(pitch, glm::dvec3(1, 0, 0)) *
                       glm::angleAxis(roll, glm::dvec3(0, 0, 1));
    return pose;
  }

 private:
  std::array<double, 8> phases_{};
};

// A thing 0.5 to 3 m away that the eyes can see when they land.
glm::dvec3 next_thing(std::mt19937& random, const Head& head, double t) {
  const double x = std::tan(glm::radians(uniform(random, -18, 18)));
  const double y = std::tan(glm::radians(uniform(random, -12, 12)));
  return head.at(t + 0.15)(uniform(random, 0.5, 3) * glm::normalize(glm::dvec3(x, y, -1)));
}

double noise(std::mt19937& random) {  // of 0.1 degrees, nearly normal
  double sum = 0;
  for (int i = 0; i < 6; ++i) sum += uniform(random, -1, 1);
  return sum * glm::radians(0.1) / std::sqrt(2.0);
}

glm::dquat quaternion_of(const glm::dmat3& matrix) {
  return glm::normalize(glm::quat_cast(matrix));
}

}  // namespace

MadeRecording made_person(std::uint32_t seed, double seconds) {
  std::mt19937 random(seed);
  const Head head(random);
  MadeRecording recording;
  for (int i = 0; i < std::lround(seconds * 90); ++i)
    recording.poses.push_back({std::llround(i * 1e9 / 90), head.at(i / 90.0)});

  constexpr double kJumpS = 0.045;
  double leaves = 0;
  glm::dvec3 from(0.0), to = next_thing(random, head, 0);
  for (int i = 0; i < std::lround(seconds * 120); ++i) {
    const double t = i / 120.0;
    if (t >= leaves + kJumpS && t >= leaves + uniform(random, 0.25, 0.6)) {
      from = to;
      to = next_thing(random, head, t);
      leaves = t;
    }
    const double share = i < 30 ? 1 : std::min(1.0, (t - leaves) / kJumpS);
    const glm::dvec3 aim = inverse(head.at(t))(glm::mix(from, to, share));
    GazeRow row;
    row.stamp_ns = std::llround(i * 1e9 / 120);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const glm::dvec3 ray = glm::normalize(aim - glm::dvec3(eye == 0 ? -0.0315 : 0.0315, 0, 0));
      row.head_direction[eye] = glm::normalize(ray + glm::dvec3(noise(random), noise(random), 0));
      row.valid[eye] = true;
    }
    recording.gaze.push_back(row);
  }
  return recording;
}

PlausibilityMeter measured(const MadeRecording& recording) {
  PlausibilityMeter meter;
  for (const PoseRow& row : recording.poses) meter.add(row);
  for (const GazeRow& row : recording.gaze) meter.add(row, recording.per_eye);
  return meter;
}

std::string judged(const MadeRecording& recording, bool notes) {
  FindingList findings;
  measured(recording).judge("pose.csv", "gaze.csv", findings);
  std::string text;
  for (const Finding& finding : findings.sorted())
    if (notes || finding.severity == Severity::warning)
      text += std::string(name_of(finding.severity)) + ": " + finding.first.problem() + "\n";
  return text;
}

glm::dmat3 rows(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z) {
  return glm::transpose(glm::dmat3(x, y, z));
}

void turn_world(MadeRecording& recording, const glm::dmat3& matrix) {
  for (PoseRow& row : recording.poses) {
    Pose& pose = row.world_from_head;
    pose.orientation = quaternion_of(matrix * glm::mat3_cast(pose.orientation));
    pose.position = matrix * pose.position;
  }
}

void turn_head(MadeRecording& recording, const glm::dmat3& matrix) {
  for (PoseRow& row : recording.poses) {
    glm::dquat& q = row.world_from_head.orientation;
    q = quaternion_of(glm::mat3_cast(q) * glm::transpose(matrix));
  }
}

void turn_gaze(MadeRecording& recording, const glm::dmat3& matrix) {
  for (GazeRow& row : recording.gaze)
    for (std::size_t eye = 0; eye < 2; ++eye) {
      glm::dvec3& d = row.head_direction[eye];
      if (d == glm::dvec3(0.0)) continue;
      d = matrix * d;
      row.valid[eye] = -d.z >= std::cos(glm::radians(kMaxGazeAngleDeg));
    }
}

void hold_every_third_pose(MadeRecording& recording) {
  std::vector<PoseRow>& poses = recording.poses;
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i].world_from_head = poses[i - i % 3].world_from_head;
}

void join_every_third_pose(MadeRecording& recording) {
  std::vector<PoseRow>& poses = recording.poses;
  for (std::size_t i = 0; i + 3 < poses.size(); i += 3) {
    const Pose from = poses[i].world_from_head, to = poses[i + 3].world_from_head;
    for (std::size_t k = 1; k < 3; ++k) {
      const double share = static_cast<double>(poses[i + k].stamp_ns - poses[i].stamp_ns) /
                           static_cast<double>(poses[i + 3].stamp_ns - poses[i].stamp_ns);
      poses[i + k].world_from_head = {glm::mix(from.position, to.position, share),
                                      glm::slerp(from.orientation, to.orientation, share)};
    }
  }
}

void smooth_gaze(MadeRecording& recording) {
  for (std::size_t eye = 0; eye < 2; ++eye) {
    glm::dvec3 smooth = recording.gaze.front().head_direction[eye];
    for (GazeRow& row : recording.gaze) {
      smooth = glm::normalize(glm::mix(smooth, row.head_direction[eye], 0.3));
      row.head_direction[eye] = smooth;
    }
  }
}

}  // namespace herr::test
