// Stretches of a recording in which somebody looks at something, and in which they turn away. Told from poses
// and gaze over half a second, not from the speed that a policy goes by.
// Before: Session, sampled at the display's rate. After: tests of where the policy's limits lie.
#pragma once

#include <filesystem>
#include <vector>

#include "sessions/session.h"

namespace herr::test {

struct HeadFrame {
  Pose world_from_head;
  glm::dvec3 world_gaze{0.0};  // unit; of the left eye
  bool gaze_seen = false;      // recorded not long ago
  double deg_s = 0;            // as motion_deg_s() has it
};

// Every frame of the session at 60 Hz.
std::vector<HeadFrame> head_frames(const std::filesystem::path& session);

// For a quarter of a second before and after it the head stays within 5 degrees and 5 cm of where it is, and
// for a tenth the gaze within 2 degrees in the world. False near the ends of a recording.
bool is_quiet(const std::vector<HeadFrame>& frames, std::size_t frame);
// The head's part of it alone.
bool head_rests(const std::vector<HeadFrame>& frames, std::size_t frame);
// From a quarter of a second before it to a quarter after the head turns by 20 degrees or more.
bool is_turn(const std::vector<HeadFrame>& frames, std::size_t frame);

}  // namespace herr::test
