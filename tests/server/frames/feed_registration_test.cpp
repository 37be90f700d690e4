// How far feed and objects are apart, against places worked out by hand.
#include "server/frames/feed_registration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>
#include <vector>

namespace herr {
namespace {

constexpr double kFeedDistance_m = 2;

struct Rig {
  FrameSample sample;
  std::vector<SessionHeader::Camera> cameras{1};

  // Eyes at the head's origin; the camera 0.1 m before it.
  Rig() {
    cameras[0].head_from_camera.position = {0, 0, -0.1};
    expose(Pose{});
  }
  void expose(const Pose& world_from_head) {
    SampledCamera camera;
    camera.world_from_camera = world_from_head * cameras[0].head_from_camera;
    sample.cameras = {camera, camera};
  }
  FeedRegistration registration() const {
    return feed_registration(sample, cameras, kFeedDistance_m).value();
  }
};

Pose turned(double yaw_deg, const glm::dvec3& position = glm::dvec3{0.0}) {
  return {position, glm::angleAxis(glm::radians(yaw_deg), glm::dvec3(0, 1, 0))};
}

TEST(FeedRegistrationTest, OfAStillHeadIsTheParallaxOfTheRig) {
  Rig rig;
  const FeedRegistration feed = rig.registration();
  EXPECT_EQ(feed.turn_arcmin, 0);
  EXPECT_EQ(feed.shift_arcmin, 0);
  EXPECT_NEAR(feed.misregistration_arcmin, 60 * glm::degrees(std::asin(0.1 / 2)), 1e-9);  // 171.96'
}

TEST(FeedRegistrationTest, ATurnSinceExposureIsUndoneButForTheWayOfTheCamera) {
  Rig rig;
  rig.sample.head.world_from_head = turned(30);
  const FeedRegistration feed = rig.registration();
  EXPECT_NEAR(feed.turn_arcmin, 1800, 1e-9);
  // The camera's centre went along a chord of a circle of 0.1 m: 2 * 0.1 * sin(15 deg).
  EXPECT_NEAR(feed.shift_arcmin, 60 * glm::degrees(std::asin(0.2 * std::sin(glm::radians(15.0)) / 2)), 1e-9);
  EXPECT_NEAR(feed.misregistration_arcmin, 60 * glm::degrees(std::asin(0.1 / 2)), 1e-9)
      << "the eye is as far from where the camera was as before";
}

TEST(FeedRegistrationTest, AStepAsideCountsWhole) {
  Rig rig;
  rig.cameras[0].head_from_camera = {};
  rig.expose(turned(0));
  rig.sample.head.world_from_head = turned(0, {0.05, 0, 0});
  const FeedRegistration feed = rig.registration();
  EXPECT_NEAR(feed.shift_arcmin, 60 * glm::degrees(std::asin(0.025)), 1e-9);
  EXPECT_NEAR(feed.misregistration_arcmin, feed.shift_arcmin, 1e-9);
  rig.sample.head.world_from_head.position.x = 50;  // farther away than the feed: a right angle
  EXPECT_NEAR(rig.registration().misregistration_arcmin, 5400, 1e-9);
}

TEST(FeedRegistrationTest, TheWorseEyeCounts) {
  Rig rig;
  rig.cameras[0].head_from_camera = {};
  rig.expose(turned(0));
  rig.sample.head_from_eye[0].position = {-0.03, 0, 0};
  rig.sample.head_from_eye[1].position = {0.04, 0, 0};
  EXPECT_NEAR(rig.registration().misregistration_arcmin, 60 * glm::degrees(std::asin(0.04 / 2)), 1e-9);
  rig.sample.cameras[1].reset();
  EXPECT_NEAR(rig.registration().misregistration_arcmin, 60 * glm::degrees(std::asin(0.03 / 2)), 1e-9);
  rig.sample.cameras[0].reset();
  EXPECT_FALSE(feed_registration(rig.sample, rig.cameras, kFeedDistance_m));
}

// The formula is a bound that far surfaces reach: no pixel of a feed drawn by the renderer's own
// rule (the point at distance D along the eye's ray, seen from where the camera was) is farther
// off, and some are nearly so.
TEST(FeedRegistrationTest, BoundsWhatRandomPixelsOfFarSurfacesShow) {
  const std::uint32_t seed = 11;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Rig rig;
  rig.sample.head.world_from_head = turned(20, {0.04, -0.03, 0.02});
  const double bound_rad = glm::radians(rig.registration().misregistration_arcmin / 60);
  const glm::dvec3 eye = rig.sample.head.world_from_head.position;
  const glm::dvec3 camera = rig.sample.cameras[0]->world_from_camera.position;
  double worst_rad = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 shown = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const glm::dvec3 line = glm::normalize(eye + kFeedDistance_m * shown - camera);
    const glm::dvec3 surface = camera + 1e7 * line;
    const glm::dvec3 truly = glm::normalize(surface - eye);
    worst_rad =
        std::max(worst_rad, std::atan2(glm::length(glm::cross(shown, truly)), glm::dot(shown, truly)));
  }
  EXPECT_LE(worst_rad, bound_rad * (1 + 1e-6));
  EXPECT_GE(worst_rad, bound_rad * 0.99);
}

}  // namespace
}  // namespace herr
