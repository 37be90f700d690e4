#include <glm/ext/matrix_transform.hpp>

#include "scenes/samples/generator/objects/objects.h"
#include "scenes/samples/generator/objects/teapot_patches.h"
#include "scenes/samples/generator/shapes/bezier_patch.h"

namespace herr::samples {

namespace {

constexpr int kSegments = 20;     // along each edge of a patch
constexpr float kScale = 0.070f;  // Newell's units to metres: 6.43 units from handle to spout

BezierPatch quarter_of(const TeapotProfile& profile) {
  BezierPatch patch;
  for (std::size_t row = 0; row < 4; ++row) {
    const auto [r, z, tangent] = profile[row];
    const float t = r * tangent;
    // Profiles run downwards on the outside, so a quarter runs clockwise to have its outside outwards.
    patch[row] = {glm::vec3(0, r, z), glm::vec3(t, r, z), glm::vec3(r, t, z), glm::vec3(r, 0, z)};
  }
  return patch;
}

BezierPatch half_of(const TeapotTube& tube) {
  BezierPatch patch;
  for (std::size_t row = 0; row < 4; ++row) {
    const TeapotTubeRow& r = tube[row];
    patch[row] = {glm::vec3(r.inner_x, 0, r.inner_z), glm::vec3(r.inner_x, -r.width, r.inner_z),
                  glm::vec3(r.outer_x, -r.width, r.outer_z), glm::vec3(r.outer_x, 0, r.outer_z)};
  }
  return patch;
}

}  // namespace

GlbObject teapot() {
  Mesh newell;  // z up
  const glm::mat4 identity(1.0f);
  for (const TeapotProfile& profile : kTeapotProfiles) {
    const Mesh quarter = bezier_mesh(quarter_of(profile), kSegments);
    for (int turn = 0; turn < 4; ++turn) {
      const float angle = 0.5f * kPi * static_cast<float>(turn);
      append(newell, quarter, glm::rotate(identity, angle, glm::vec3(0, 0, 1)));
    }
  }
  for (const TeapotTube& tube : kTeapotTubes) {
    const Mesh half = bezier_mesh(half_of(tube), kSegments);
    append(newell, half, identity);
    append(newell, half, glm::scale(identity, glm::vec3(1, -1, 1)));
  }
  Mesh mesh;
  const glm::mat4 upright = glm::rotate(identity, -0.5f * kPi, glm::vec3(1, 0, 0));
  append(mesh, newell, glm::scale(identity, glm::vec3(kScale)) * upright);
  return {"teapot", {{mesh, {"glaze", {0.70f, 0.16f, 0.07f}, 0.0f, 0.25f, {}, {}}}}};
}

}  // namespace herr::samples
