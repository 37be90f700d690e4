// Axes and angles: the arithmetic of imports against slow obvious code.
#include "sessions/import/map/axis_directions.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <random>
#include <string>
#include <vector>

namespace herr {
namespace {

AxisDirections axes(const char* x, const char* y, const char* z) {
  return *AxisDirections::from_words({x, y, z});
}

TEST(Axes, AreRefusedUnlessTheySpanSpace) {
  EXPECT_FALSE(AxisDirections::from_words({"right", "up", "left"}));
  EXPECT_FALSE(AxisDirections::from_words({"right", "up", "north"}));
  EXPECT_FALSE(axes("right", "up", "back").left_handed());
  EXPECT_TRUE(axes("right", "up", "forward").left_handed());
  EXPECT_FALSE(axes("right", "forward", "up").left_handed());
}

TEST(Axes, KnowTheirWords) {
  const std::array<std::string, 3> words{"down", "right", "back"};
  EXPECT_EQ(AxisDirections::from_words(words)->words(), words);
  EXPECT_EQ(AxisDirections().words(), (std::array<std::string, 3>{"right", "up", "back"}));
  EXPECT_EQ(axes("right", "up", "back"), AxisDirections());
  EXPECT_NE(axes("right", "up", "forward"), AxisDirections());
}

TEST(Axes, OfUnityBecomeOursAsTheRecordingsSay) {
  // p = (x, y, -z), q = (-qx, -qy, qz, qw).
  const AxisDirections unity = axes("right", "up", "forward");
  EXPECT_EQ(unity.to_ours({1, 2, 3}), glm::dvec3(1, 2, -3));
  const glm::dquat q = rotation_to_ours(glm::dquat(0.5, 0.1, 0.2, 0.3), unity, unity);
  EXPECT_EQ(q, glm::dquat(0.5, -0.1, -0.2, 0.3));
}

TEST(Axes, OfOursLoseNoDigit) {
  const glm::dquat q(0.9999999954012598, 1.7235119219432893e-05, -3.723164869105633e-05,
                     -8.668468978228771e-05);
  EXPECT_EQ(rotation_to_ours(q, {}, {}), q);
}

// Every pair of frames of one handedness: turning a vector there and carrying it over must give the same as
// carrying it over and turning it here.
TEST(Axes, CarryRotationsOverForEveryPairOfFrames) {
  const std::array<std::array<const char*, 2>, 3> lines{
      {{"right", "left"}, {"up", "down"}, {"forward", "back"}}};
  constexpr std::array<std::array<std::size_t, 3>, 6> kOrders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  std::vector<AxisDirections> all;
  for (const auto& order : kOrders)
    for (std::size_t signs = 0; signs < 8; ++signs)
      all.push_back(axes(lines[order[0]][signs & 1], lines[order[1]][(signs >> 1) & 1],
                         lines[order[2]][(signs >> 2) & 1]));
  ASSERT_EQ(all.size(), 48u);
  const glm::dquat q = glm::normalize(glm::dquat(0.3, -0.5, 0.7, 0.2));
  const glm::dvec3 v(0.2, -1.1, 0.6);
  int pairs = 0;
  for (const AxisDirections& world : all)
    for (const AxisDirections& body : all) {
      if (world.left_handed() != body.left_handed()) continue;
      ++pairs;
      const glm::dvec3 expected = world.to_ours(q * v);
      const glm::dvec3 found = rotation_to_ours(q, world, body) * body.to_ours(v);
      // A dozen roundings of numbers below 2: 1e-14 has a margin of ten.
      ASSERT_LT(glm::distance(expected, found), 1e-14);
    }
  EXPECT_EQ(pairs, 2 * 24 * 24);
}

// Unity: R = Ry Rx Rz, written out as matrices.
TEST(EulerAngles, AreAppliedInTheOrderOfTheLetters) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> degrees(-720, 720);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 a = glm::radians(glm::dvec3(degrees(random), degrees(random), degrees(random)));
    const double cx = std::cos(a.x), sx = std::sin(a.x), cy = std::cos(a.y), sy = std::sin(a.y);
    const double cz = std::cos(a.z), sz = std::sin(a.z);
    const glm::dmat3 rx(1, 0, 0, 0, cx, sx, 0, -sx, cx);  // columns
    const glm::dmat3 ry(cy, 0, -sy, 0, 1, 0, sy, 0, cy);
    const glm::dmat3 rz(cz, sz, 0, -sz, cz, 0, 0, 0, 1);
    const glm::dvec3 v(0.3, 0.4, 0.5);
    // The angles reach 12.6 rad, rounded to 2e-15; a few of these add up.
    EXPECT_LT(glm::distance(euler_rotation(a, "zxy") * v, ry * (rx * (rz * v))), 1e-14);
    EXPECT_LT(glm::distance(euler_rotation(a, "xyz") * v, rz * (ry * (rx * v))), 1e-14);
  }
}

}  // namespace
}  // namespace herr
