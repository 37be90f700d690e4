#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "scenes/samples/generator/objects/objects.h"
#include "scenes/samples/generator/shapes/lathe.h"
#include "scenes/samples/generator/shapes/tube.h"

namespace herr::samples {

namespace {

using glm::vec3;

constexpr float kRadiusM = 0.34f;
constexpr float kCentreM = 0.90f;  // height of the middle

// A flat band in the x-z plane: thin across, `wide` along y.
Mesh ring(float radius, float height, float wide) {
  constexpr int kPoints = 108;
  std::vector<TubePoint> path;
  for (int i = 0; i < kPoints; ++i) {
    const float t = 2.0f * kPi * static_cast<float>(i) / kPoints;
    path.push_back({{radius * std::cos(t), height, radius * std::sin(t)}, wide});
  }
  // The first frame's side is horizontal (radial), its other axis vertical.
  return tube(path, {8, true, {0.35f, 1.0f}});
}

Mesh ball(float radius) {
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= 8; ++i) {
    const float t = kPi * (static_cast<float>(i) / 8.0f - 0.5f);
    profile.push_back({i == 0 || i == 8 ? 0.0f : radius * std::cos(t), radius * std::sin(t), false});
  }
  return lathe(profile, {24, 2});
}

Mesh stand() {
  return lathe({{0.00f, 0.00f, true},
                {0.22f, 0.00f, true},
                {0.225f, 0.02f},
                {0.215f, 0.045f, true},
                {0.16f, 0.055f},
                {0.10f, 0.085f},
                {0.055f, 0.12f, true},
                {0.072f, 0.145f},
                {0.045f, 0.17f, true},
                {0.030f, 0.21f},
                {0.055f, 0.30f},
                {0.062f, 0.34f},
                {0.030f, 0.40f, true},
                {0.045f, 0.415f},
                {0.030f, 0.43f, true},
                {0.026f, 0.47f},
                {0.040f, 0.505f},
                {0.035f, 0.52f, true},
                {0.00f, 0.525f, true}},
               {32, 3});
}

// One of four arms that carry the horizon ring, a quarter circle below the sphere.
Mesh arm() {
  std::vector<TubePoint> path;
  for (int i = 0; i <= 24; ++i) {
    const float t = 0.5f * kPi * static_cast<float>(i) / 24.0f;
    const float radius = kRadiusM + 0.045f;
    path.push_back({{radius * std::sin(t), -radius * std::cos(t), 0.0f}, 0.012f});
  }
  return tube(path, {8, false, glm::vec2(1.0f)});
}

}  // namespace

GlbObject armillary_sphere() {
  Mesh mesh;
  const glm::mat4 identity(1.0f);
  const glm::mat4 middle = glm::translate(identity, vec3(0.0f, kCentreM, 0.0f));
  const auto turned = [](const glm::mat4& base, float degrees, const vec3& axis) {
    return glm::rotate(base, degrees * kPi / 180.0f, axis);
  };
  append(mesh, stand(), identity);
  append(mesh, ring(kRadiusM + 0.045f, 0.0f, 0.022f), middle);  // horizon
  for (int i = 0; i < 4; ++i)
    append(mesh, arm(), turned(middle, 90.0f * static_cast<float>(i) + 45.0f, {0, 1, 0}));
  // The sphere itself leans by the latitude: axis, colures, equator, tropics, polar circles, ecliptic.
  const glm::mat4 sphere = turned(turned(middle, 25.0f, {0, 1, 0}), -38.0f, {0, 0, 1});
  append(mesh, ring(kRadiusM, 0.0f, 0.018f), turned(sphere, 90.0f, {1, 0, 0}));
  append(mesh, ring(kRadiusM, 0.0f, 0.018f), turned(sphere, 90.0f, {0, 0, 1}));
  append(mesh, ring(kRadiusM - 0.004f, 0.0f, 0.018f), sphere);
  for (const float side : {-1.0f, 1.0f}) {
    const auto parallel = [&](float degrees) {
      const float angle = degrees * kPi / 180.0f;
      append(mesh, ring((kRadiusM - 0.004f) * std::cos(angle), side * kRadiusM * std::sin(angle), 0.009f),
             sphere);
    };
    parallel(23.4f);
    parallel(66.6f);
  }
  append(mesh, ring(kRadiusM - 0.010f, 0.0f, 0.034f), turned(sphere, 23.4f, {1, 0, 0}));
  append(mesh, ball(0.085f), sphere);
  append(mesh,
         tube({{{0, -kRadiusM - 0.05f, 0}, 0.009f}, {{0, kRadiusM + 0.05f, 0}, 0.009f}},
              {12, false, glm::vec2(1.0f)}),
         sphere);
  for (const float side : {-1.0f, 1.0f}) {
    append(mesh, ball(0.022f), glm::translate(sphere, vec3(0.0f, side * (kRadiusM + 0.06f), 0.0f)));
  }
  return {"armillary sphere", {{mesh, {"brass", {0.86f, 0.62f, 0.25f}, 1.0f, 0.15f, {}, {}}}}};
}

}  // namespace herr::samples
