#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "scenes/samples/generator/objects/objects.h"
#include "scenes/samples/generator/pictures/noise.h"
#include "scenes/samples/generator/pictures/textures.h"
#include "scenes/samples/generator/shapes/grid.h"
#include "scenes/samples/generator/shapes/lathe.h"

namespace herr::samples {

namespace {

using glm::vec2;
using glm::vec3;

constexpr int kLeaves = 34;
constexpr float kThicknessM = 0.0016f;  // at the rib

// A leaf leaves the ground upwards and bows over in the x-y plane.
struct Leaf {
  float length_m, width_m;
  float lean;  // radians from the vertical at the stem
  float bow;   // radians by which it turns from stem to tip
  float sway;  // sideways bend, metres at the tip
};

// The rib at t in [0, 1]: integral of a direction that turns with t^1.5, in 24 steps.
vec3 rib(const Leaf& leaf, float t) {
  vec3 at(0.0f);
  constexpr int kSteps = 24;
  for (int i = 0; i < kSteps; ++i) {
    const float s = t * (static_cast<float>(i) + 0.5f) / kSteps;
    const float angle = leaf.lean + leaf.bow * s * std::sqrt(s);
    at += leaf.length_m * t / kSteps * vec3(std::sin(angle), std::cos(angle), 0.0f);
  }
  at.z = leaf.sway * t * t;
  return at;
}

float half_width(const Leaf& leaf, float t) {
  // A stalk over the first third, then a blade that is widest at 0.6 and ends in a point.
  const float blade = glm::smoothstep(0.22f, 0.60f, t) * std::pow(glm::max(1.0f - t, 0.0f), 0.6f) * 1.6f;
  return 0.004f * (1.0f - t) + 0.5f * leaf.width_m * blade;
}

// u runs once around the thin lens of the cross-section, v from stem to tip.
Mesh leaf_mesh(const Leaf& leaf) {
  return smooth_grid_mesh(12, 30, [&](float u, float v) {
    const float t = 0.9995f * v;
    const vec3 at = rib(leaf, t);
    const vec3 along = glm::normalize(rib(leaf, t + 5e-4f) - rib(leaf, t));
    const vec3 across = glm::normalize(glm::cross(along, vec3(-along.y, along.x, 0.0f)));
    const vec3 above = glm::cross(across, along);
    const float angle = -2.0f * kPi * u;
    const float side = std::cos(angle), lift = std::sin(angle);
    const float half = half_width(leaf, t);
    const float thickness =
        glm::mix(0.004f, kThicknessM, glm::smoothstep(0.0f, 0.35f, t)) * (1.0f - 0.8f * t);
    // The blade is folded a little along its rib and waves along its edges.
    const float fold =
        0.30f * half * side * side + 0.10f * half * side * std::sin(17.0f * t + leaf.lean * 9.0f);
    const vec3 position = at + half * side * across + (fold + thickness * lift) * above;
    return Vertex{position, vec3(0.0f), {t, 0.02f + 0.96f * (0.5f + 0.5f * side)}};
  });
}

Mesh pot() {
  return lathe({{0.00f, 0.010f, true},
                {0.130f, 0.010f, true},
                {0.135f, 0.000f, true},
                {0.150f, 0.00f, true},
                {0.205f, 0.300f, true},
                {0.222f, 0.302f, true},
                {0.236f, 0.372f},
                {0.230f, 0.380f},
                {0.214f, 0.378f},
                {0.208f, 0.360f},
                {0.196f, 0.320f, true}},
               {56, 4});
}

Mesh soil() {
  return smooth_grid_mesh(60, 10, [](float u, float v) {
    const float angle = 2.0f * kPi * u, radius = 0.203f * (1.0f - v);
    const vec3 at(radius * std::cos(angle), 0.0f, -radius * std::sin(angle));
    const float lumps = 0.012f * layered_noise(40.0f * at + 3.5f, 2, 151);
    return Vertex{at + vec3(0.0f, 0.338f + 0.02f * v + lumps * glm::smoothstep(0.0f, 0.2f, v), 0.0f),
                  vec3(0.0f),
                  {u, v}};
  });
}

}  // namespace

GlbObject plant() {
  Mesh mesh;
  const glm::mat4 identity(1.0f);
  const UvRect leaf_third{{0.0f, 0.01f}, {1.0f, 0.32f}};
  append(mesh, pot(), identity, {{0.0f, 0.35f}, {1.0f, 0.65f}});
  append(mesh, soil(), identity, {{0.0f, 0.68f}, {1.0f, 0.99f}});
  for (int i = 0; i < kLeaves; ++i) {
    const auto random = [i](int which) { return hashed(i, which, 0, 161); };
    const float outer = static_cast<float>(i) / (kLeaves - 1);  // the young ones stand upright in the middle
    Leaf leaf{};
    leaf.length_m = glm::mix(1.18f, 0.72f, outer) * (0.88f + 0.24f * random(0));
    leaf.width_m = glm::mix(0.10f, 0.15f, random(1));
    leaf.lean = glm::mix(0.05f, 0.62f, outer) + 0.12f * random(2);
    leaf.bow = glm::mix(0.75f, 1.75f, outer) * (0.8f + 0.5f * random(3));
    leaf.sway = 0.16f * (random(4) - 0.5f);
    const float around = 2.39996f * static_cast<float>(i) + 0.5f * random(5);  // the golden angle
    const glm::mat4 turned = glm::rotate(identity, around, vec3(0, 1, 0));
    const vec3 root(0.02f + 0.07f * outer, 0.335f, 0.0f);
    append(mesh, leaf_mesh(leaf), glm::translate(turned, root), leaf_third);
  }
  return {"plant", {{mesh, {"foliage", vec3(1.0f), 0.0f, 0.55f, {}, plant_picture()}}}};
}

}  // namespace herr::samples
