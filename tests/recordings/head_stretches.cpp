#include "tests/recordings/head_stretches.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "server/quality/motion_policy.h"

namespace herr::test {
namespace {

constexpr double kFrames_hz = 60;
constexpr std::size_t kHeadFrames = 15, kGazeFrames = 6;  // a quarter and a tenth of a second
constexpr TimeNs kOldestGazeNs = 150'000'000;

double turned_deg(const Pose& a, const Pose& b) {
  const glm::dquat turn = b.orientation * glm::conjugate(a.orientation);
  return glm::degrees(2 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w)));
}

double apart_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

bool in_the_middle(const std::vector<HeadFrame>& frames, std::size_t frame) {
  return frame >= kHeadFrames && frame + kHeadFrames < frames.size();
}

}  // namespace

std::vector<HeadFrame> head_frames(const std::filesystem::path& folder) {
  Session session = Session::open(folder);
  std::vector<HeadFrame> frames;
  for (TimeNs t_ns = session.start_ns(); t_ns <= session.end_ns();
       t_ns = session.start_ns() + std::llround(static_cast<double>(frames.size()) * 1e9 / kFrames_hz)) {
    const FrameSample sample = session.sample(t_ns);
    HeadFrame& frame = frames.emplace_back();
    frame.world_from_head = sample.head.world_from_head;
    frame.world_gaze = frame.world_from_head.orientation * sample.gaze.head_direction[0];
    const SampleSource source = sample.gaze.source[0];
    frame.gaze_seen = (source == SampleSource::exact || source == SampleSource::held) &&
                      sample.gaze.age_ns <= kOldestGazeNs;
    frame.deg_s = motion_deg_s(sample.head_speed);
  }
  return frames;
}

bool head_rests(const std::vector<HeadFrame>& frames, std::size_t frame) {
  if (!in_the_middle(frames, frame)) return false;
  const Pose& here = frames[frame].world_from_head;
  for (std::size_t i = frame - kHeadFrames; i <= frame + kHeadFrames; ++i) {
    const Pose& there = frames[i].world_from_head;
    if (turned_deg(here, there) > 5 || glm::distance(here.position, there.position) > 0.05) return false;
  }
  return true;
}

bool is_quiet(const std::vector<HeadFrame>& frames, std::size_t frame) {
  if (!head_rests(frames, frame)) return false;
  for (std::size_t i = frame - kGazeFrames; i <= frame + kGazeFrames; ++i) {
    if (!frames[i].gaze_seen || apart_deg(frames[frame].world_gaze, frames[i].world_gaze) > 2) return false;
  }
  return true;
}

bool is_turn(const std::vector<HeadFrame>& frames, std::size_t frame) {
  return in_the_middle(frames, frame) && turned_deg(frames[frame - kHeadFrames].world_from_head,
                                                    frames[frame + kHeadFrames].world_from_head) >= 20;
}

}  // namespace herr::test
