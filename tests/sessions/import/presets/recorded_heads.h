// A head that looks around, and what files of other axes hold of it. Before: preset_import.h.
// After: tests of presets of trajectories.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "tests/sessions/import/presets/preset_import.h"

namespace herr::test {

// A person who looks around: yaw to the left from -40 to 40 degrees, pitch upwards from -10 to 10, a little
// roll.
struct HeadAngles {
  double left, upwards, roll;
};
inline HeadAngles angles_of(int i) {
  return {glm::radians(40 * std::sin(0.05 * i)), glm::radians(10 * std::cos(0.07 * i)),
          glm::radians(3 * std::sin(0.03 * i))};
}
// Of our axes: world from head.
inline glm::dmat3 head_of(int i) {
  const HeadAngles a = angles_of(i);
  return glm::mat3_cast(glm::angleAxis(a.left, glm::dvec3(0, 1, 0)) *
                        glm::angleAxis(a.upwards, glm::dvec3(1, 0, 0)) *
                        glm::angleAxis(a.roll, glm::dvec3(0, 0, 1)));
}
// Where the head of row i looks: (-sin left cos up, sin up, -cos left cos up).
inline glm::dvec3 forward_of(int i) {
  const HeadAngles a = angles_of(i);
  return {-std::sin(a.left) * std::cos(a.upwards), std::sin(a.upwards),
          -std::cos(a.left) * std::cos(a.upwards)};
}

// The columns say where x, y and z of a frame point in ours.
inline const glm::dmat3 kYUp(1.0);  // right up back
inline const glm::dmat3 kZUp(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1),
                             glm::dvec3(0, 1, 0));  // right forward up
inline const glm::dmat3 kForwardLeftUp(glm::dvec3(0, 0, -1), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0));
inline const glm::dmat3 kUpRightForward(glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1));
inline const glm::dmat3 kLeftBackUp(glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0));
inline const glm::dmat3 kForwardUpRight(glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0));
inline const glm::dmat3 kCamera(glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0),
                                glm::dvec3(0, 0, -1));  // right down forward
inline const glm::dmat3 kLeftUpForward(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1));

// The rotation that a file in these axes holds for the head of row i.
inline glm::dmat3 recorded(int i, const glm::dmat3& world, const glm::dmat3& body) {
  return glm::transpose(world) * head_of(i) * body;
}
inline std::string wxyz(const glm::dmat3& rotation) {
  const glm::dquat q = glm::quat_cast(rotation);
  return joined({q.w, q.x, q.y, q.z});
}
inline std::string xyzw(const glm::dmat3& rotation, const std::string& separator = ",") {
  const glm::dquat q = glm::quat_cast(rotation);
  return joined({q.x, q.y, q.z, q.w}, separator);
}

inline void expect_heads(const PresetImport& got, int rows) {
  ASSERT_EQ(got.poses.size(), static_cast<std::size_t>(rows));
  for (const int i : {0, rows / 3, rows - 1}) {
    SCOPED_TRACE(i);
    expect_near(got.forward(static_cast<std::size_t>(i)), forward_of(i), 1e-7);
    expect_near(got.up(static_cast<std::size_t>(i)), head_of(i) * glm::dvec3(0, 1, 0), 1e-7);
  }
}

}  // namespace herr::test
