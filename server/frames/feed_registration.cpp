#include "server/frames/feed_registration.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace herr {
namespace {

constexpr double kArcMinutesPerDegree = 60;

double arcmin(double radians) {
  return glm::degrees(radians) * kArcMinutesPerDegree;
}

double angle_between(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat turn = a * glm::conjugate(b);
  return 2 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
}

// Under which an offset is seen at most; a right angle once it reaches the distance itself.
double parallax(double offset_m, double distance_m) {
  return std::asin(std::min(1.0, offset_m / distance_m));
}

}  // namespace

std::optional<FeedRegistration> feed_registration(const FrameSample& sample,
                                                  std::span<const SessionHeader::Camera> cameras,
                                                  double feed_distance_m) {
  std::optional<FeedRegistration> worst;
  const Pose& world_from_head = sample.head.world_from_head;
  for (std::size_t eye = 0; eye < sample.cameras.size() && !cameras.empty(); ++eye) {
    if (!sample.cameras[eye]) continue;
    const Pose& at_exposure = sample.cameras[eye]->world_from_camera;
    const Pose now = world_from_head * cameras[std::min(eye, cameras.size() - 1)].head_from_camera;
    const glm::dvec3 eye_place = world_from_head(sample.head_from_eye[eye].position);
    if (!worst) worst.emplace();
    worst->turn_arcmin =
        std::max(worst->turn_arcmin, arcmin(angle_between(now.orientation, at_exposure.orientation)));
    worst->shift_arcmin =
        std::max(worst->shift_arcmin,
                 arcmin(parallax(glm::distance(now.position, at_exposure.position), feed_distance_m)));
    worst->misregistration_arcmin =
        std::max(worst->misregistration_arcmin,
                 arcmin(parallax(glm::distance(eye_place, at_exposure.position), feed_distance_m)));
  }
  return worst;
}

}  // namespace herr
