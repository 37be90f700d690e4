// Which objects a recorded head has before it, and where its recording should stand to have them there.
#include "server/inspect/scene_in_view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace herr {
namespace {

constexpr double kHalf = 0.70710678118654752;  // sine and cosine of 45 degrees

// Sees 45 degrees to each side.
DisplayProfile square_profile() {
  DisplayProfile profile;
  Viewport viewport;
  viewport.tan_left = viewport.tan_down = -1;
  viewport.tan_right = viewport.tan_up = 1;
  profile.viewports = {viewport};
  return profile;
}

Scene ball(const glm::dvec3& centre, double radius) {
  Scene scene;
  scene.materials.resize(1);
  Instance instance;
  instance.name = "ball/part";
  instance.kind = ShapeKind::sphere;
  for (int axis = 0; axis < 3; ++axis) instance.world_from_object[axis] *= radius;
  instance.world_from_object[3] = centre;
  scene.instances.push_back(instance);
  scene.objects.push_back({"ball", {}, 0, 1, true});
  return scene;
}

// About +Y: the head then looks along (-sin, 0, -cos) of the angle.
Pose head(const glm::dvec3& place, double degrees) {
  const double half = degrees * 3.14159265358979323846 / 360;
  return {place, {std::cos(half), 0, std::sin(half), 0}};
}

struct Seen {
  SceneInView in_view;
  double share = -1;
};

Seen seen(const Scene& scene, const std::vector<Pose>& poses) {
  std::vector<SceneObject> objects(1);
  objects[0].name = "ball";
  Seen result;
  result.in_view = look_at_scene(scene, poses, poses.front(), square_profile(), objects);
  result.share = objects[0].in_view.value_or(-1);
  return result;
}

void expect_pose(const std::optional<Pose>& pose, const glm::dvec3& position, const glm::dquat& orientation) {
  ASSERT_TRUE(pose.has_value());
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(pose->position[axis], position[axis], 1e-9) << axis;
  EXPECT_NEAR(std::abs(glm::dot(pose->orientation, orientation)), 1, 1e-9);
}

// The box of a ball of 0.5 m, 5 m ahead and x to the right, begins at x - 0.5 and ends 5.5 m ahead: at its
// farther side it meets the border of 45 degrees as soon as x - 0.5 < 5.5.
TEST(SceneInView, ABoxIsSeenUntilItLiesWhollyBeyondABorder) {
  const Pose upright = head({0, 1.6, 0}, 0);
  EXPECT_EQ(seen(ball({0, 1.6, -5}, 0.5), {upright}).share, 1);
  EXPECT_EQ(seen(ball({5.9, 1.6, -5}, 0.5), {upright}).share, 1);
  EXPECT_EQ(seen(ball({6.1, 1.6, -5}, 0.5), {upright}).share, 0);
  EXPECT_EQ(seen(ball({0, 1.6, 5}, 0.5), {upright}).share, 0);
  EXPECT_EQ(seen(ball({0, 1.6, -5}, 0.5), {upright, head({0, 1.6, 0}, 90), upright, upright}).share, 0.75);
}

// A middle 5 m ahead and 5.9 m to the right is atan(5.9 / 5) = 49.7 degrees off: past the border of 45,
// though its box is not. Of heads turned by 30, -10, 60 and 180 degrees from a ball ahead two have its middle
// within 45 degrees, and -10 is nearest.
TEST(SceneInView, AMiddleIsToldBesideTheBoxAndWhenItIsNearestToStraightAhead) {
  std::vector<SceneObject> objects(1);
  objects[0].name = "ball";
  const auto look = [&](const Scene& scene, const std::vector<Pose>& poses) {
    look_at_scene(scene, poses, poses.front(), square_profile(), objects);
  };
  look(ball({5.9, 1.6, -5}, 0.5), {head({0, 1.6, 0}, 0)});
  EXPECT_EQ(objects[0].in_view, 1);
  EXPECT_EQ(objects[0].middle_in_view, 0);
  EXPECT_FALSE(objects[0].most_central.has_value());
  look(ball({0, 1.6, -5}, 0.5),
       {head({0, 1.6, 0}, 30), head({0, 1.6, 0}, -10), head({0, 1.6, 0}, 60), head({0, 1.6, 0}, 180)});
  EXPECT_EQ(objects[0].middle_in_view, 0.5);
  expect_pose(objects[0].most_central, {0, 1.6, 0}, head({0, 0, 0}, -10).orientation);
}

TEST(SceneInView, WhatIsSeenInMostPosesNeedsNoOtherPlace) {
  const Seen got = seen(ball({0, 1.6, -5}, 0.5), {head({0, 1.6, 0}, 0)});
  EXPECT_EQ(got.in_view.subject_share, 1);
  EXPECT_FALSE(got.in_view.proposal.has_value());
}

// The ball stands at the right, towards +X: the recording turns by -90 degrees about +Y. With the head at
// (1, 1.6, 2), which that turn would bring to (-2, 1.6, 1), it moves by (3, 0, 1) to keep the head where it
// is.
TEST(SceneInView, ARecordingThatLooksPastIsTurnedWhereItsHeadStands) {
  const Seen got = seen(ball({6, 1.6, 2}, 0.5), {head({1, 1.6, 2}, 0)});
  EXPECT_EQ(got.share, 0);
  expect_pose(got.in_view.proposal, {3, 0, 1}, {kHalf, 0, -kHalf, 0});
  // Said in the document, it holds: the turn comes on top of what the document has.
  Scene scene = ball({6, 1.6, 2}, 0.5);
  scene.world_from_session = *got.in_view.proposal;
  EXPECT_EQ(seen(scene, {head({1, 1.6, 2}, 0)}).share, 1);
  scene.world_from_session = {{0, 0, 0}, {kHalf, 0, kHalf, 0}};  // to +X turned away, to -X
  const Seen again = seen(scene, {head({1, 1.6, 2}, 0)});
  ASSERT_TRUE(again.in_view.proposal.has_value());
  scene.world_from_session = *again.in_view.proposal;
  EXPECT_EQ(seen(scene, {head({1, 1.6, 2}, 0)}).in_view.subject_share, 1);
}

// 10 m behind, 0.1 m in radius: 1.1 degrees across. The head moves to where the ball is 0.3 m before its
// face, which is farther than 0.1 / sin(20 degrees) = 0.292 m from its middle: 0.4 m from it, looking as
// before.
TEST(SceneInView, FromTooFarItIsBroughtNear) {
  const Seen got = seen(ball({0, 1.6, 10}, 0.1), {head({0, 1.6, 0}, 0)});
  expect_pose(got.in_view.proposal, {0, 0, 10.4}, {1, 0, 0, 0});
}

// In the middle of a ball of 2 m radius: back by 2 / sin(20 degrees) = 5.848 m. The head was 1 m above its
// middle and stays so: 1 / 5.848 is less than the tangent of 20 degrees.
TEST(SceneInView, FromWithinItIsMovedOut) {
  const Pose turned = head({0, 1, 0}, 180);  // looks along +Z
  Scene scene = ball({0, 0, 0}, 2);
  scene.instances[0].world_from_object[3] = {0, 0, -0.5};  // the middle lies behind the head
  const Seen got = seen(scene, {turned});
  expect_pose(got.in_view.proposal, {0, 0, -0.5 - 2 / std::sin(20 * 3.14159265358979323846 / 180)},
              {1, 0, 0, 0});
}

TEST(SceneInView, TheLineIsOneOfASceneDocument) {
  EXPECT_EQ(world_from_session_text({{3, -0.00001, 1.23456}, {kHalf, 0, -kHalf, 0}}),
            "\"world_from_session\": {\"position\": [3, 0, 1.2346], \"orientation_xyzw\": [0, -0.707107, 0, "
            "0.707107]}");
}

}  // namespace
}  // namespace herr
