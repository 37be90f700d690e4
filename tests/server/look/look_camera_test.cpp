// The camera of `herr look`: how far it stands, where, and how large a sphere appears.
#include "server/look/look_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace herr {
namespace {

constexpr double kDegree = 3.141592653589793 / 180;

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double within) {
  EXPECT_LT(glm::distance(a, b), within) << a.x << ", " << a.y << ", " << a.z;
}

// A sphere of radius r at distance d is seen under the half angle asin(r / d); on a plane at distance 1 its
// silhouette is a circle of radius tan of that.
TEST(LookCamera, ASphereFillsNineteenTwentiethsOfTheShorterSideAtAnyScaleAndAngle) {
  for (const double radius : {1e-4, 1.0, 1e5}) {
    for (const double fov_deg : {10.0, 35.0, 120.0}) {
      LookOptions options;
      options.width_px = 900, options.height_px = 300, options.fov_deg = fov_deg;
      const LookCamera camera = look_camera(options, {}, {{3 * radius, 0, 0}, radius});
      const Viewport& view = camera.profile.viewports.front();
      const double silhouette = std::tan(std::asin(radius / camera.distance));
      EXPECT_NEAR(silhouette / view.tan_up, 0.95, 1e-12);
      EXPECT_NEAR(view.tan_up, std::tan(0.5 * fov_deg * kDegree), 1e-12);
      EXPECT_NEAR(view.tan_right, 3 * view.tan_up, 1e-12) << "pixels are square";
      EXPECT_NEAR(glm::distance(camera.world_from_camera.position, glm::dvec3(3 * radius, 0, 0)),
                  camera.distance, 1e-9 * radius);
    }
  }
}

TEST(LookCamera, AzimuthsGrowCounterClockwiseSeenFromAboveAndZeroSeesTheFront) {
  LookOptions options;
  const BoundingSphere ball{{1, 2, 3}, 0.5};
  const auto place = [&](const LookDirection& from) {
    const LookCamera camera = look_camera(options, from, ball);
    return (camera.world_from_camera.position - ball.centre) / camera.distance;
  };
  expect_near(place({0, 0}), {0, 0, 1}, 1e-12);
  expect_near(place({90, 0}), {1, 0, 0}, 1e-12);  // seen from above +Z is below, +X at the right
  expect_near(place({-90, 0}), {-1, 0, 0}, 1e-12);
  expect_near(place({180, 0}), {0, 0, -1}, 1e-12);
  expect_near(place({0, 90}), {0, 1, 0}, 1e-12);
  expect_near(place({0, 30}), {0, 0.5, std::sqrt(0.75)}, 1e-12);
  options.distance = 2;
  EXPECT_NEAR(look_camera(options, {}, ball).distance, 2 * look_camera(LookOptions{}, {}, ball).distance,
              1e-12);
}

TEST(LookCamera, LooksAtTheMiddleWithTheWorldUprightAndFromAboveWithTheFrontBelow) {
  const BoundingSphere ball{{1, 2, 3}, 0.5};
  for (const LookDirection from : {LookDirection{30, 15}, {200, -40}, {0, 90}}) {
    const LookCamera camera = look_camera({}, from, ball);
    const glm::dquat& turned = camera.world_from_camera.orientation;
    expect_near(camera.world_from_camera.position + camera.distance * (turned * glm::dvec3(0, 0, -1)),
                ball.centre, 1e-12);
    EXPECT_NEAR((turned * glm::dvec3(1, 0, 0)).y, 0, 1e-12) << "the horizon is level";
    EXPECT_GE((turned * glm::dvec3(0, 1, 0)).y, -1e-12);
  }
  const glm::dquat from_above = look_camera({}, {0, 90}, ball).world_from_camera.orientation;
  expect_near(from_above * glm::dvec3(0, -1, 0), {0, 0, 1}, 1e-12);
}

}  // namespace
}  // namespace herr
