#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "scenes/samples/generator/objects/objects.h"
#include "scenes/samples/generator/pictures/noise.h"
#include "scenes/samples/generator/shapes/blobs.h"
#include "scenes/samples/generator/shapes/lathe.h"
#include "scenes/samples/generator/shapes/surface_nets.h"

namespace herr::samples {

namespace {

using glm::vec3;

constexpr float kCellM = 0.0077f;

// A sitting hare, 0.9 m to the tips of its ears, facing +z.

float hare_body(const vec3& p) {
  float d = tapered_capsule(p, {0, 0.20f, -0.10f}, {0, 0.37f, 0.05f}, 0.175f, 0.115f);
  d = smooth_union(d, ellipsoid(p, {0.0f, 0.29f, 0.08f}, {0.100f, 0.130f, 0.085f}), 0.06f);  // breast
  d = smooth_union(d, tapered_capsule(p, {0, 0.40f, 0.06f}, {0, 0.53f, 0.10f}, 0.085f, 0.070f), 0.06f);
  d = smooth_union(d, ellipsoid(p, {0.0f, 0.14f, -0.30f}, {0.055f, 0.065f, 0.055f}), 0.02f);  // tail
  for (const float side : {-1.0f, 1.0f}) {
    const auto at = [side](float x, float y, float z) { return vec3(side * x, y, z); };
    d = smooth_union(d, ellipsoid(p, at(0.130f, 0.165f, -0.07f), {0.070f, 0.145f, 0.150f}), 0.025f);
    d = smooth_union(
        d, tapered_capsule(p, at(0.155f, 0.035f, -0.04f), at(0.150f, 0.032f, 0.19f), 0.040f, 0.033f), 0.02f);
    d = smooth_union(
        d, tapered_capsule(p, at(0.070f, 0.30f, 0.11f), at(0.066f, 0.05f, 0.175f), 0.050f, 0.032f), 0.03f);
    d = smooth_union(d, ellipsoid(p, at(0.066f, 0.030f, 0.195f), {0.036f, 0.030f, 0.055f}), 0.015f);
  }
  return d;
}

float hare_head(const vec3& p) {
  float d = ellipsoid(p, {0.0f, 0.565f, 0.125f}, {0.076f, 0.080f, 0.105f});
  d = smooth_union(d, ellipsoid(p, {0.0f, 0.535f, 0.205f}, {0.048f, 0.045f, 0.050f}), 0.04f);
  d = smooth_union(d, ellipsoid(p, {0.0f, 0.552f, 0.252f}, {0.016f, 0.011f, 0.010f}), 0.008f);
  d = smooth_difference(d, tapered_capsule(p, {0, 0.535f, 0.258f}, {0, 0.505f, 0.240f}, 0.003f, 0.003f),
                        0.008f);
  for (const float side : {-1.0f, 1.0f}) {
    const auto at = [side](float x, float y, float z) { return vec3(side * x, y, z); };
    d = smooth_union(d, ellipsoid(p, at(0.026f, 0.522f, 0.228f), {0.028f, 0.024f, 0.026f}), 0.010f);
    d = smooth_difference(d, ellipsoid(p, at(0.074f, 0.585f, 0.160f), {0.018f, 0.022f, 0.024f}), 0.012f);
    d = smooth_union(d, ellipsoid(p, at(0.060f, 0.585f, 0.158f), {0.016f, 0.018f, 0.019f}), 0.003f);
    // Ears: flat capsules, hollowed in front.
    const vec3 root = at(0.034f, 0.620f, 0.075f), middle = at(0.075f, 0.760f, 0.020f),
               tip = at(0.098f, 0.900f, -0.010f);
    float ear = smooth_union(tapered_capsule(p, root, middle, 0.027f, 0.044f),
                             tapered_capsule(p, middle, tip, 0.044f, 0.010f), 0.03f);
    const vec3 front(0.0f, 0.0f, 0.030f);
    const float hollow = smooth_union(tapered_capsule(p, root + front, middle + front, 0.012f, 0.035f),
                                      tapered_capsule(p, middle + front, tip + front, 0.035f, 0.006f), 0.02f);
    ear = smooth_difference(ear, hollow, 0.010f);
    d = smooth_union(d, ear, 0.022f);
  }
  return d;
}

// What a hand-held scanner adds: soft waves of registration, grain, and vertices that sit anywhere.
void roughen(Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const vec3 p = mesh.positions[i];
    const float fur = 0.0042f * layered_noise({40.0f * p.x, 22.0f * p.y, 40.0f * p.z}, 4, 171);
    const auto key = static_cast<std::int32_t>(i);
    const vec3 jitter = vec3(hashed(key, 0, 0, 181), hashed(key, 1, 0, 181), hashed(key, 2, 0, 181)) - 0.5f;
    const vec3 normal = mesh.normals[i];
    const vec3 sideways = jitter - glm::dot(jitter, normal) * normal;
    mesh.positions[i] +=
        fur * normal + 0.55f * kCellM * sideways + 0.18f * kCellM * glm::dot(jitter, normal) * normal;
  }
  compute_normals(mesh);
}

Mesh column() {
  return lathe({{0.00f, 0.00f, true},
                {0.29f, 0.00f, true},
                {0.29f, 0.05f, true},
                {0.27f, 0.055f, true},
                {0.285f, 0.080f},
                {0.265f, 0.105f, true},
                {0.235f, 0.115f, true},
                {0.205f, 0.16f},
                {0.198f, 0.40f},
                {0.190f, 0.66f},
                {0.205f, 0.695f, true},
                {0.225f, 0.705f, true},
                {0.240f, 0.725f},
                {0.260f, 0.745f, true},
                {0.275f, 0.750f, true},
                {0.275f, 0.80f, true},
                {0.00f, 0.80f, true}},
               {64, 4});
}

}  // namespace

GlbObject hare() {
  const auto field = [](const vec3& p) { return smooth_union(hare_body(p), hare_head(p), 0.035f); };
  Mesh scan = surface_nets(field, {{-0.26f, -0.03f, -0.39f}, {0.26f, 0.95f, 0.31f}, kCellM});
  roughen(scan);
  stand_on_ground(scan);
  Mesh mesh;
  append(mesh, scan, glm::translate(glm::mat4(1.0f), vec3(0.0f, 0.80f, 0.03f)));
  append(mesh, column(), glm::mat4(1.0f));
  return {"hare", {{mesh, {"sandstone", {0.55f, 0.42f, 0.30f}, 0.0f, 0.9f, {}, {}}}}};
}

}  // namespace herr::samples
