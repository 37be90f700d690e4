#include "renderer/foveation/gaze_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "renderer/foveation/polar_map.h"

namespace herr {

GazeFrame gaze_frame(const glm::dvec3& gaze_in_eye) {
  // Scaled by its largest component first: the square of a tiny or huge one would leave the range of double.
  const double largest =
      std::max({std::abs(gaze_in_eye.x), std::abs(gaze_in_eye.y), std::abs(gaze_in_eye.z)});
  if (!std::isfinite(gaze_in_eye.x + gaze_in_eye.y + gaze_in_eye.z) || largest <= 0) return {};
  const glm::dvec3 gaze = glm::normalize(gaze_in_eye / largest);
  const glm::dvec3 ahead{0, 0, -1};
  const double cosine = glm::dot(ahead, gaze);
  // 1 + cos is the quaternion's w; below 1e-9 the axis is lost to rounding: turn about the up axis.
  if (1.0 + cosine < 1e-9) return {{-1, 0, 0}, {0, 1, 0}, gaze};
  const glm::dvec3 axis = glm::cross(ahead, gaze);
  const glm::dquat turn = glm::normalize(glm::dquat(1.0 + cosine, axis.x, axis.y, axis.z));
  return {turn * glm::dvec3{1, 0, 0}, turn * glm::dvec3{0, 1, 0}, gaze};
}

double eccentricity_deg(const glm::dvec3& gaze, const glm::dvec3& direction) {
  return std::atan2(glm::length(glm::cross(gaze, direction)), glm::dot(gaze, direction)) * kDegreesPerRadian;
}

FrustumPlanes frustum_planes(const Viewport& v) {
  return {{glm::normalize(glm::dvec3{1, 0, v.tan_left}), glm::normalize(glm::dvec3{-1, 0, -v.tan_right}),
           glm::normalize(glm::dvec3{0, 1, v.tan_down}), glm::normalize(glm::dvec3{0, -1, -v.tan_up})}};
}

namespace {

// Farthest point from the gaze on the arc between two directions of a border.
double farthest_on_arc_deg(const glm::dvec3& gaze, const glm::dvec3& from, const glm::dvec3& to) {
  double farthest = std::max(eccentricity_deg(gaze, from), eccentricity_deg(gaze, to));
  // On the great circle through both, it is the projection of -gaze onto the circle's
  // plane, if that is on the arc.
  const glm::dvec3 normal = glm::cross(from, to);
  const double normal_length2 = glm::dot(normal, normal);
  if (normal_length2 <= 0) return farthest;
  const glm::dvec3 candidate = -(gaze - normal * (glm::dot(gaze, normal) / normal_length2));
  const bool on_arc =
      glm::dot(glm::cross(from, candidate), normal) >= 0 && glm::dot(glm::cross(candidate, to), normal) >= 0;
  if (on_arc && glm::dot(candidate, candidate) > 0) {
    farthest = std::max(farthest, eccentricity_deg(gaze, candidate));
  }
  return farthest;
}

}  // namespace

double theta_max_deg(const GazeFrame& frame, std::span<const Viewport> viewports, Eye eye) {
  double farthest = 0;
  for (const Viewport& v : viewports) {
    if (v.eye != eye) continue;
    const std::array<glm::dvec3, 4> corners{glm::dvec3{v.tan_left, v.tan_down, -1},
                                            {v.tan_right, v.tan_down, -1},
                                            {v.tan_right, v.tan_up, -1},
                                            {v.tan_left, v.tan_up, -1}};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      farthest =
          std::max(farthest, farthest_on_arc_deg(frame.gaze, corners[i], corners[(i + 1) % corners.size()]));
    }
    const FrustumPlanes planes = frustum_planes(v);
    const bool holds_antipode =
        std::all_of(std::begin(planes.normal), std::end(planes.normal),
                    [&](const glm::dvec3& n) { return glm::dot(n, -frame.gaze) >= 0; });
    if (holds_antipode) return 180.0;
  }
  return farthest;
}

}  // namespace herr
