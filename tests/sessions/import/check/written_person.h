// A made person as a logger of some convention writes it, with columns of the test's own names.
// Before: made_person.h. After: the tests of this folder.
#pragma once

#include <array>
#include <cstdio>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <initializer_list>
#include <string>

#include "tests/sessions/inspect/made_person.h"

namespace herr::test {

// The columns say where x, y and z of a frame point in ours (x right, y up, z back).
inline const glm::dmat3 kRightUpBack(1.0);
inline const glm::dmat3 kRightUpForward(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1));
inline const glm::dmat3 kLeftUpForward(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1));
inline const glm::dmat3 kForwardRightUp(glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0));
inline const glm::dmat3 kRightForwardUp(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0));
inline const glm::dmat3 kRightDownForward(glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, -1));

struct WrittenPose {
  double seconds = 0;
  glm::dvec3 position{0.0};    // in the world's axes of the file
  glm::dmat3 rotation{1.0};    // world from head, both of the file
  glm::dvec3 gaze{0.0};        // in the gaze's axes
  glm::dvec3 world_gaze{0.0};  // in the world's axes of the file
};

inline std::string text_of_numbers(std::initializer_list<double> numbers, const char* separator = ",") {
  std::string text;
  for (const double number : numbers) {
    std::array<char, 40> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.9f", number);
    text += (text.empty() ? "" : separator) + std::string(buffer.data());
  }
  return text;
}

inline std::string text_of(const glm::dvec3& v) {
  return text_of_numbers({v.x, v.y, v.z});
}
inline std::string xyzw_text(const glm::dmat3& rotation) {
  const glm::dquat q = glm::normalize(glm::quat_cast(rotation));
  return text_of_numbers({q.x, q.y, q.z, q.w});
}

// A line for each pose, with the gaze row nearest to it.
inline std::string written(const MadeRecording& person, const std::string& header, const glm::dmat3& world,
                           const glm::dmat3& head, const glm::dmat3& gaze,
                           const std::function<std::string(const WrittenPose&)>& line) {
  std::string text = header.empty() ? "" : header + "\n";
  std::size_t at = 0;
  for (const PoseRow& pose : person.poses) {
    while (at + 1 < person.gaze.size() && person.gaze[at + 1].stamp_ns <= pose.stamp_ns) ++at;
    const glm::dvec3& looks = person.gaze[at].head_direction[0];
    const glm::dmat3 turn = glm::mat3_cast(pose.world_from_head.orientation);
    text += line({static_cast<double>(pose.stamp_ns) * 1e-9,
                  glm::transpose(world) * pose.world_from_head.position, glm::transpose(world) * turn * head,
                  glm::transpose(gaze) * looks, glm::transpose(world) * (turn * looks)}) +
            "\n";
  }
  return text;
}

// Walks where it looks, at 1 m/s.
inline MadeRecording walking_person(std::uint32_t seed, double seconds) {
  MadeRecording person = made_person(seed, seconds);
  glm::dvec3 place(0, 1.6, 0);
  for (std::size_t i = 0; i < person.poses.size(); ++i) {
    Pose& pose = person.poses[i].world_from_head;
    const glm::dvec3 ahead = pose.orientation * glm::dvec3(0, 0, -1);
    if (i > 0)
      place += glm::dvec3(ahead.x, 0, ahead.z) *
               (1e-9 * static_cast<double>(person.poses[i].stamp_ns - person.poses[i - 1].stamp_ns));
    pose.position = place;
  }
  return person;
}

}  // namespace herr::test
