#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "scenes/samples/generator/objects/objects.h"
#include "scenes/samples/generator/shapes/lathe.h"
#include "scenes/samples/generator/shapes/tube.h"

namespace herr::samples {

namespace {

// The (2, 3) torus knot, standing upright: its axis of symmetry is z.
Mesh torus_knot() {
  constexpr int kPoints = 360;
  std::vector<TubePoint> path;
  for (int i = 0; i < kPoints; ++i) {
    const float t = 2.0f * kPi * static_cast<float>(i) / kPoints;
    const float radius = 0.265f + 0.115f * std::cos(3.0f * t);
    path.push_back(
        {{radius * std::cos(2.0f * t), radius * std::sin(2.0f * t), 0.125f * std::sin(3.0f * t)}, 0.068f});
  }
  return tube(path, {22, true, glm::vec2(1.0f)});
}

Mesh stand() {
  return lathe({{0.00f, 0.00f, true},
                {0.26f, 0.00f, true},
                {0.26f, 0.03f, true},
                {0.18f, 0.055f},
                {0.07f, 0.12f},
                {0.045f, 0.30f},
                {0.060f, 0.52f},
                {0.040f, 0.74f},
                {0.045f, 0.80f},
                {0.095f, 0.84f, true},
                {0.095f, 0.86f, true},
                {0.00f, 0.88f, true}},
               {48, 4});
}

}  // namespace

GlbObject knot() {
  Mesh mesh;
  const glm::mat4 raised = glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 1.265f, 0.0f));
  // Turned by 90 degrees one of its three lobes points down and rests on the stand.
  append(mesh, torus_knot(), glm::rotate(raised, -0.5f * kPi, glm::vec3(0, 0, 1)));
  append(mesh, stand(), glm::mat4(1.0f));
  return {"knot", {{mesh, {"polished steel", {0.80f, 0.82f, 0.85f}, 1.0f, 0.08f, {}, {}}}}};
}

}  // namespace herr::samples
