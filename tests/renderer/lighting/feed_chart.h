// A camera, an eye and what lies between them and the feed, traced in double precision by the laws
// themselves: what tests of the feed in mirrors and glass expect. Everything in eye space, metres; the eye is
// the origin. Before: a test places a ball, a plate and a camera. After: it compares what the renderer shows.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <optional>

#include "tests/renderer/half_pixels.h"
#include "tests/renderer/test_scenes.h"

namespace herr::test {

// A ray and the share of what it brings that is seen.
struct TracedRay {
  glm::dvec3 origin{0.0}, direction{0, 0, -1};
  double weight = 1;
};

// Fresnel's equations for unpolarised light: the share that is reflected. `ratio`: index of this side over
// that of the other.
inline double fresnel(double cosine, double ratio) {
  const double other = std::sqrt(1 - ratio * ratio * (1 - cosine * cosine));
  const double s = (ratio * cosine - other) / (ratio * cosine + other);
  const double p = (cosine - ratio * other) / (cosine + ratio * other);
  return 0.5 * (s * s + p * p);
}

// Snell's law in the plane of incidence; `normal` against the ray.
inline glm::dvec3 snell(const glm::dvec3& direction, const glm::dvec3& normal, double ratio) {
  const double cosine = -glm::dot(direction, normal);
  const glm::dvec3 along = ratio * (direction + cosine * normal);
  return along - std::sqrt(1 - glm::dot(along, along)) * normal;
}

// Straight through a clear ball: two interfaces, at each of which what is reflected is lost.
inline std::optional<TracedRay> through_ball(const TracedRay& ray, const glm::dvec3& centre, double radius,
                                             double index) {
  const glm::dvec3 to_centre = centre - ray.origin;
  const double middle = glm::dot(to_centre, ray.direction);
  const double miss2 = glm::dot(to_centre, to_centre) - middle * middle;
  if (!(miss2 < radius * radius) || middle < 0) return std::nullopt;
  const glm::dvec3 enters = ray.origin + (middle - std::sqrt(radius * radius - miss2)) * ray.direction;
  const glm::dvec3 normal = (enters - centre) / radius;
  const double reflected = fresnel(-glm::dot(ray.direction, normal), 1 / index);
  const glm::dvec3 inside = snell(ray.direction, normal, 1 / index);
  const glm::dvec3 leaves = enters - 2 * glm::dot(enters - centre, inside) * inside;
  const glm::dvec3 inward = (centre - leaves) / radius;
  // It leaves at the angle at which it entered, and so loses the same share.
  return TracedRay{leaves, snell(inside, inward, index), ray.weight * (1 - reflected) * (1 - reflected)};
}

// Off a plane mirror, where the ray meets it.
inline std::optional<TracedRay> off_plane(const TracedRay& ray, const glm::dvec3& point,
                                          const glm::dvec3& normal) {
  const double way = glm::dot(point - ray.origin, normal) / glm::dot(ray.direction, normal);
  if (!(way > 0)) return std::nullopt;
  return TracedRay{ray.origin + way * ray.direction,
                   ray.direction - 2 * glm::dot(ray.direction, normal) * normal, ray.weight};
}

// Direction from the eye in which a ray shows the feed: to where it leaves the feed's sphere, which is taken
// to lie at least twice as far from the eye as the place from which the ray comes.
inline glm::dvec3 where_feed_is_met(const TracedRay& ray, double feed_m) {
  const double distance_m = std::max(feed_m, 2 * glm::length(ray.origin));
  const double along = glm::dot(ray.origin, ray.direction),
               beyond = glm::dot(ray.origin, ray.origin) - distance_m * distance_m;
  return ray.origin + (std::sqrt(along * along - beyond) - along) * ray.direction;
}

// The camera's image and how it was taken: pixels by Brown-Conrady's radial terms, or Kannala and Brandt's.
struct ChartCamera {
  TestCamera taken;
  Pose eye_from_camera;
  double distance_m = 1.8;

  // Camera pixel of what the feed shows in a direction from the eye.
  glm::dvec2 pixel(const glm::dvec3& direction) const {
    const glm::dvec3 point = inverse(eye_from_camera)(glm::normalize(direction) * distance_m);
    const CameraModel& m = taken.model;
    const double x = point.x, y = -point.y, z = -point.z, side = std::hypot(x, y);
    const auto& k = m.distortion;
    if (m.kind == CameraModelKind::pinhole) {
      const double r2 = side * side / (z * z), grows = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
      return {m.fx * grows * x / z + m.cx, m.fy * grows * y / z + m.cy};
    }
    const double angle = std::atan2(side, z), a2 = angle * angle;
    const double radius = angle * (1 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
    return {m.fx * radius * x / side + m.cx, m.fy * radius * y / side + m.cy};
  }
  // True well within the camera's view: `margin_px` from the outermost pixel centres.
  bool sees(const glm::dvec3& direction, double margin_px) const {
    const glm::dvec3 ahead = glm::conjugate(eye_from_camera.orientation) * direction;
    if (taken.model.kind == CameraModelKind::pinhole && !(-ahead.z > 0.2 * glm::length(ahead))) return false;
    const glm::dvec2 at = pixel(direction);
    return at.x > margin_px && at.y > margin_px && at.x < taken.model.width_px - 1 - margin_px &&
           at.y < taken.model.height_px - 1 - margin_px;
  }
  // The image there, blended from the four pixels around.
  glm::dvec3 colour(const glm::dvec3& direction) const {
    const glm::dvec2 at = pixel(direction);
    const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
    const auto texel = [&](int column, int row) {
      const CameraImage& image = *taken.image;
      column = std::clamp(column, 0, image.width_px - 1);
      row = std::clamp(row, 0, image.height_px - 1);
      const std::uint16_t* p = &image.rgba_half[4 * static_cast<std::size_t>(row * image.width_px + column)];
      return glm::dvec3{from_half(p[0]), from_half(p[1]), from_half(p[2])};
    };
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), at.x - x),
                    glm::mix(texel(x, y + 1), texel(x + 1, y + 1), at.x - x), at.y - y);
  }
};

using ChartTexel = std::array<std::uint16_t, 4>;

// 320 x 240 pixels, a little right of the eye, turned and rolled.
inline ChartCamera chart_camera(CameraModelKind kind, const std::function<ChartTexel(int, int)>& chart) {
  ChartCamera camera;
  camera.taken = TestCamera::pinhole(320, 240, 45, chart);
  CameraModel& m = camera.taken.model;
  m.kind = kind;
  m.distortion = {-0.05, 0.008, 0, 0, -0.001};
  if (kind == CameraModelKind::kb4) {
    m.fx = m.fy = 110;  // 160 pixels at 80 degrees
    m.distortion = {0.02, -0.008, 0.003, -0.0006};
  }
  m.prepare();
  camera.eye_from_camera = {{0.05, 0.02, -0.03},
                            glm::angleAxis(0.08, glm::normalize(glm::dvec3{0.2, 1, 0.3}))};
  return camera;
}

// An eye somewhere in the world that looks somewhere, and the camera's image as taken beside it.
inline FrameSample sample_with(const ChartCamera& camera) {
  FrameSample sample = sample_from({0.2, 1.6, 0.1});
  sample.head.world_from_head.orientation = glm::angleAxis(0.4, glm::normalize(glm::dvec3{0.1, 1, -0.2}));
  camera.taken.attach_to(sample);
  for (auto& eye : sample.cameras) {
    eye->world_from_camera = sample.head.world_from_head * camera.eye_from_camera;
  }
  return sample;
}

// Objects in eye space stand there in the world.
inline glm::dmat4x3 world_from_eye(const FrameSample& sample) {
  const Pose& head = sample.head.world_from_head;
  return glm::dmat4x3(glm::translate(glm::dmat4{1.0}, head.position) * glm::mat4_cast(head.orientation));
}

inline void add_ball(Scene& scene, const glm::dvec3& centre, double radius, const Material& material,
                     const glm::dmat4x3& place) {
  Instance ball;
  ball.name = "ball";
  ball.kind = ShapeKind::sphere;
  ball.material = static_cast<std::uint32_t>(scene.materials.size());
  ball.world_from_object = glm::dmat4x3(
      glm::dmat4(place) * glm::scale(glm::translate(glm::dmat4{1.0}, centre), glm::dvec3(radius)));
  scene.materials.push_back(material);
  scene.instances.push_back(ball);
}

}  // namespace herr::test
