// Rotations of the head as matrices, for tests: what rows should give, by products of matrices alone.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sessions/import/rows/head_reader.h"
#include "tests/sessions/import/rows/fake_rows.h"

namespace herr::test {

using Words = std::array<std::string, 3>;
inline const Words kOurs{"right", "up", "back"}, kUnity{"right", "up", "forward"},
    kUnreal{"forward", "right", "up"}, kZUp{"right", "forward", "up"},
    kCameraDown{"right", "down", "forward"};

// Columns: where x, y and z point in ours, by the meaning of the words.
inline glm::dmat3 ours_from(const Words& words) {
  glm::dmat3 m(0.0);
  for (int i = 0; i < 3; ++i) {
    const std::string& word = words[static_cast<std::size_t>(i)];
    const int axis = word == "right" || word == "left" ? 0 : word == "up" || word == "down" ? 1 : 2;
    m[i][axis] = word == "left" || word == "down" || word == "forward" ? -1 : 1;
  }
  return m;
}

// The matrix that turns about x (0), y (1) or z (2): x to y, y to z, z to x for positive angles.
inline glm::dmat3 turn_about(int axis, double deg) {
  const double c = std::cos(glm::radians(deg)), s = std::sin(glm::radians(deg));
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  glm::dmat3 m(1.0);
  m[a][a] = c;
  m[a][b] = s;
  m[b][a] = -s;
  m[b][b] = c;
  return m;
}

// Half turns and turns just short of them, where one of a quaternion's numbers is near 0, and ordinary ones.
inline std::vector<glm::dmat3> some_rotations() {
  std::vector<glm::dmat3> rotations{glm::dmat3(1.0)};
  for (int axis = 0; axis < 3; ++axis)
    for (const double deg : {180.0, 179.9999, -179.9999, 90.0, 1e-4})
      rotations.push_back(turn_about(axis, deg));
  rotations.push_back(turn_about(0, 180) * turn_about(2, 90));  // a half turn about a diagonal
  rotations.push_back(turn_about(1, 20) * turn_about(0, -35) * turn_about(2, 10));
  rotations.push_back(turn_about(2, 140) * turn_about(1, 70) * turn_about(0, -100));
  return rotations;
}

inline HeadColumns head_columns(RotationKind kind, const std::string& rotation, const Words& world = kOurs,
                                const Words& head = kOurs) {
  HeadColumns columns;
  columns.time.kind = TimeColumns::Kind::rate;
  columns.rotation_kind = kind;
  if (!rotation.empty()) columns.rotation = group_of(rotation);
  columns.world_axes = *AxisDirections::from_words(world);
  columns.head_axes = *AxisDirections::from_words(head);
  return columns;
}

// Seventeen digits of each number, with blanks between them.
inline std::string row_of(const std::vector<double>& numbers) {
  std::string row;
  for (const double number : numbers) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.17g", number);
    row += (row.empty() ? "" : " ") + std::string(text.data());
  }
  return row;
}

struct ReadHead {
  std::optional<Pose> pose;
  ReadingCounts counts;
};

inline ReadHead read_head(const HeadColumns& columns, const std::string& names, const std::string& row) {
  FakeRows source(names, {row});
  const HeadReader reader(source, columns);
  ReadHead result;
  if (source.next()) result.pose = reader.read(source, result.counts);
  return result;
}

// The pose's rotation as a matrix, column by column from turned axes.
inline glm::dmat3 matrix_of(const Pose& pose) {
  return {pose.orientation * glm::dvec3(1, 0, 0), pose.orientation * glm::dvec3(0, 1, 0),
          pose.orientation * glm::dvec3(0, 0, 1)};
}

// The largest difference of two numbers.
inline double difference(const glm::dmat3& a, const glm::dmat3& b) {
  double most = 0;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) most = std::fmax(most, std::abs(a[i][k] - b[i][k]));
  return most;
}

}  // namespace herr::test
