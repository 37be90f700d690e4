#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "scenes/samples/generator/objects/objects.h"
#include "scenes/samples/generator/pictures/textures.h"
#include "scenes/samples/generator/shapes/grid.h"
#include "scenes/samples/generator/shapes/lathe.h"
#include "scenes/samples/generator/shapes/tube.h"

namespace herr::samples {

namespace {

using glm::vec3;

// A farmhouse chair facing +z: turned legs, stretchers, a saddle seat, a back of spindles under a crest.

// A rod of unit length turned with beads and coves; placed between two points by `between`.
Mesh turned_rod(float thick, bool ornate) {
  if (!ornate) {
    return lathe({{0.0f, 0.0f, true},
                  {0.6f * thick, 0.0f, true},
                  {0.8f * thick, 0.3f},
                  {thick, 0.5f},
                  {0.8f * thick, 0.7f},
                  {0.6f * thick, 1.0f, true},
                  {0.0f, 1.0f, true}},
                 {10, 3});
  }
  return lathe({{0.0f, 0.0f, true},
                {0.55f * thick, 0.0f, true},
                {0.62f * thick, 0.10f},
                {0.95f * thick, 0.24f},
                {0.60f * thick, 0.30f, true},
                {1.00f * thick, 0.33f},
                {0.60f * thick, 0.36f, true},
                {0.72f * thick, 0.45f},
                {1.08f * thick, 0.60f},
                {0.95f * thick, 0.68f},
                {0.58f * thick, 0.735f, true},
                {1.05f * thick, 0.77f},
                {0.58f * thick, 0.805f, true},
                {0.80f * thick, 0.90f},
                {0.70f * thick, 1.0f, true},
                {0.0f, 1.0f, true}},
               {16, 3});
}

glm::mat4 between(const vec3& from, const vec3& to) {
  const vec3 axis = to - from;
  const vec3 up = glm::normalize(axis);
  const vec3 reference = std::abs(up.z) < 0.9f ? vec3(0, 0, 1) : vec3(1, 0, 0);
  const vec3 right = glm::normalize(glm::cross(up, reference));
  return {glm::vec4(right, 0), glm::vec4(axis, 0), glm::vec4(glm::cross(right, up), 0), glm::vec4(from, 1)};
}

// A squared-off ellipsoid, hollowed for sitting. u around, v from the underside to the top.
Mesh seat() {
  const auto squared = [](float x) { return std::copysign(std::pow(std::abs(x), 0.45f), x); };
  return smooth_grid_mesh(48, 24, [=](float u, float v) {
    const float around = 2.0f * kPi * u, up = kPi * (v - 0.5f);
    const float reach = std::pow(std::cos(up * 0.9999f), 0.35f);
    const float x = squared(std::cos(around)) * reach, z = -squared(std::sin(around)) * reach;
    const float narrow = 1.0f + 0.10f * z;  // wider in front
    const float sink = v > 0.5f ? 0.016f * std::exp(-4.0f * (x * x + (z + 0.15f) * (z + 0.15f))) : 0.0f;
    const float y = 0.021f * squared(std::sin(up)) - sink;
    return Vertex{
        {0.225f * x * narrow, 0.45f + y, 0.215f * z}, vec3(0.0f), {0.5f + 0.45f * x, 0.5f + 0.45f * z}};
  });
}

Mesh crest() {
  std::vector<TubePoint> path;
  for (int i = 0; i <= 48; ++i) {
    const float t = 2.0f * static_cast<float>(i) / 48.0f - 1.0f;
    const float end = std::sqrt(glm::max(1.0f - std::pow(std::abs(t), 8.0f), 0.02f));
    path.push_back(
        {{0.245f * t, 0.945f + 0.028f * (1.0f - t * t), -0.285f - 0.045f * (1.0f - t * t)}, 0.042f * end});
  }
  return tube(path, {20, false, {0.33f, 1.0f}});
}

}  // namespace

GlbObject chair() {
  Mesh mesh;
  const glm::mat4 identity(1.0f);
  append(mesh, seat(), identity);
  append(mesh, crest(), identity);
  const auto rod = [&](const Mesh& shape, const vec3& from, const vec3& to) {
    append(mesh, shape, between(from, to));
  };
  const Mesh leg = turned_rod(0.030f, true), stretcher = turned_rod(0.017f, false);
  const Mesh post = turned_rod(0.022f, true), spindle = turned_rod(0.013f, false);
  for (const float side : {-1.0f, 1.0f}) {
    const vec3 front_foot(0.215f * side, 0.0f, 0.205f), front_top(0.165f * side, 0.445f, 0.150f);
    const vec3 back_foot(0.205f * side, 0.0f, -0.225f), back_top(0.150f * side, 0.445f, -0.145f);
    rod(leg, front_foot, front_top);
    rod(leg, back_foot, back_top);
    rod(stretcher, glm::mix(front_foot, front_top, 0.40f), glm::mix(back_foot, back_top, 0.40f));
    rod(post, {0.185f * side, 0.455f, -0.180f}, {0.215f * side, 0.945f, -0.295f});
  }
  rod(stretcher, {-0.19f, 0.178f, -0.005f}, {0.19f, 0.178f, -0.005f});
  rod(stretcher, {-0.188f, 0.24f, 0.175f}, {0.188f, 0.24f, 0.175f});
  for (int i = -2; i <= 2; ++i) {
    const auto at = static_cast<float>(i);
    rod(spindle, {0.062f * at, 0.455f, -0.185f}, {0.073f * at, 0.955f, -0.328f + 0.006f * at * at});
  }
  stand_on_ground(mesh);  // the splayed legs dip their edges
  return {"chair", {{mesh, {"oak", vec3(1.0f), 0.0f, 0.5f, {}, wood_picture()}}}};
}

}  // namespace herr::samples
