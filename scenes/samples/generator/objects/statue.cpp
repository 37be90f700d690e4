#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "scenes/samples/generator/objects/objects.h"
#include "scenes/samples/generator/pictures/textures.h"
#include "scenes/samples/generator/shapes/blobs.h"
#include "scenes/samples/generator/shapes/box.h"
#include "scenes/samples/generator/shapes/surface_nets.h"

namespace herr::samples {

namespace {

using glm::vec3;

constexpr float kCellM = 0.0118f, kHeadCellM = 0.0055f;

// A robed woman with a raised torch, 1.75 m to the crown, facing +z. x > 0 is her left.

float face(const vec3& p) {
  float d = ellipsoid(p, {0.0f, 1.600f, 0.015f}, {0.078f, 0.108f, 0.092f});                    // skull
  d = smooth_union(d, ellipsoid(p, {0.0f, 1.545f, 0.040f}, {0.054f, 0.062f, 0.060f}), 0.03f);  // jaw
  d = smooth_union(d, ellipsoid(p, {0.0f, 1.503f, 0.078f}, {0.020f, 0.015f, 0.016f}), 0.02f);  // chin
  d = smooth_union(d, tapered_capsule(p, {-0.040f, 1.620f, 0.086f}, {0.040f, 1.620f, 0.086f}, 0.010f, 0.010f),
                   0.02f);  // brow
  for (const float side : {-1.0f, 1.0f}) {
    d = smooth_difference(d, ellipsoid(p, {0.031f * side, 1.603f, 0.110f}, {0.019f, 0.010f, 0.014f}), 0.014f);
    d = smooth_union(d, ellipsoid(p, {0.031f * side, 1.602f, 0.086f}, {0.015f, 0.011f, 0.0145f}), 0.003f);
    d = smooth_union(d, ellipsoid(p, {0.036f * side, 1.570f, 0.082f}, {0.020f, 0.018f, 0.015f}),
                     0.025f);  // cheek
  }
  d = smooth_union(d, tapered_capsule(p, {0, 1.622f, 0.098f}, {0, 1.576f, 0.118f}, 0.0065f, 0.0105f), 0.014f);
  d = smooth_union(d, tapered_capsule(p, {-0.009f, 1.573f, 0.108f}, {0.009f, 1.573f, 0.108f}, 0.007f, 0.007f),
                   0.006f);  // nostrils
  for (const float lip : {1.543f, 1.533f}) {
    d = smooth_union(d, ellipsoid(p, {0.0f, lip, 0.099f}, {0.021f, 0.0055f, 0.010f}), 0.004f);
  }
  return d;
}

float hair(const vec3& p) {
  // Parted in the middle, combed back in waves over the ears into a bun.
  const float parted = std::abs(p.x);
  const float waves = 0.0045f * std::sin(150.0f * (p.z - 0.5f * parted) + 60.0f * (p.y - 1.6f));
  const float part = 0.008f * std::exp(-parted / 0.008f);
  float d = ellipsoid(p, {0.0f, 1.624f, -0.006f}, {0.093f, 0.104f, 0.100f}) + waves + part;
  const float hairline = 0.050f + 0.45f * (p.y - 1.62f) - 0.6f * parted * glm::smoothstep(1.64f, 1.70f, p.y);
  d = smooth_difference(d, hairline - p.z, 0.010f);
  const float bun = ellipsoid(p, {0.0f, 1.615f, -0.118f}, {0.050f, 0.046f, 0.044f});
  return smooth_union(d, bun + 0.004f * std::sin(120.0f * p.y + 80.0f * p.x), 0.010f);
}

float head(const vec3& p) {
  // A neck a little thinner than the trunk's, so that only the fillet under the jaw shows.
  const float neck = tapered_capsule(p, {0, 1.45f, -0.002f}, {0, 1.54f, 0.012f}, 0.047f, 0.045f);
  return smooth_union(smooth_union(face(p), hair(p), 0.006f), neck, 0.030f);
}

float trunk(const vec3& p) {
  float d = ellipsoid(p, {0.0f, 1.255f, 0.0f}, {0.158f, 0.170f, 0.108f});
  for (const float side : {-1.0f, 1.0f}) {
    d = smooth_union(d, ellipsoid(p, {0.072f * side, 1.255f, 0.085f}, {0.064f, 0.066f, 0.052f}), 0.04f);
  }
  d = smooth_union(d, ellipsoid(p, {0.0f, 1.06f, 0.0f}, {0.125f, 0.150f, 0.094f}), 0.08f);
  d = smooth_union(d, ellipsoid(p, {0.015f, 0.900f, -0.005f}, {0.170f, 0.140f, 0.130f}), 0.08f);
  d = smooth_union(d, tapered_capsule(p, {-0.16f, 1.365f, 0}, {0.16f, 1.350f, 0}, 0.055f, 0.055f), 0.06f);
  d = smooth_union(d, tapered_capsule(p, {0, 1.37f, -0.01f}, {0, 1.53f, 0.012f}, 0.058f, 0.047f), 0.05f);
  // The robe falls in fine folds below the breast and is tied at the waist.
  const float folds = std::sin(21.0f * std::atan2(p.x, p.z) + 3.0f * std::sin(6.0f * p.y));
  d += 0.005f * folds * glm::smoothstep(1.36f, 1.18f, p.y);
  const float belt = std::hypot(std::hypot(p.x, 1.32f * p.z) - 0.128f, p.y - 1.085f) - 0.013f;
  return smooth_union(d, belt, 0.012f);
}

float arms(const vec3& p) {
  // Right arm raised with the torch.
  const vec3 elbow(-0.330f, 1.480f, 0.050f), wrist(-0.345f, 1.730f, 0.110f);
  float d = tapered_capsule(p, {-0.18f, 1.37f, 0}, elbow, 0.056f, 0.043f);
  d = smooth_union(d, tapered_capsule(p, elbow, wrist, 0.043f, 0.028f), 0.03f);
  d = smooth_union(d, ellipsoid(p, {-0.345f, 1.775f, 0.115f}, {0.036f, 0.045f, 0.036f}), 0.02f);
  float torch = tapered_capsule(p, {-0.345f, 1.66f, 0.145f}, {-0.345f, 1.89f, 0.125f}, 0.013f, 0.024f);
  torch = smooth_union(torch, ellipsoid(p, {-0.345f, 1.900f, 0.125f}, {0.050f, 0.020f, 0.050f}), 0.012f);
  const float twist = 0.004f * std::sin(3.0f * std::atan2(p.z - 0.125f, p.x + 0.345f) + 30.0f * p.y);
  torch = smooth_union(
      torch, tapered_capsule(p, {-0.345f, 1.93f, 0.125f}, {-0.335f, 2.02f, 0.120f}, 0.040f, 0.006f) + twist,
      0.015f);
  d = smooth_union(d, torch, 0.010f);
  // Left arm bent, the hand gathering the cloak.
  const vec3 left_elbow(0.265f, 1.105f, -0.035f), left_wrist(0.185f, 1.020f, 0.165f);
  d = std::min(d, tapered_capsule(p, {0.18f, 1.355f, 0}, left_elbow, 0.056f, 0.044f));
  d = smooth_union(d, tapered_capsule(p, left_elbow, left_wrist, 0.044f, 0.029f), 0.03f);
  return smooth_union(d, ellipsoid(p, {0.165f, 1.010f, 0.195f}, {0.040f, 0.030f, 0.042f}), 0.02f);
}

float skirt(const vec3& p) {
  // A bell from the hips to the ground, its folds deeper towards the hem, one knee pressing forward.
  const float down = glm::clamp((0.92f - p.y) / 0.92f, 0.0f, 1.0f);
  const float angle = std::atan2(p.x, p.z);
  const float radius = glm::mix(0.150f, 0.235f, down * std::sqrt(down));
  const float fold =
      std::sin(13.0f * angle + 1.4f * std::sin(3.0f * p.y)) + 0.5f * std::sin(29.0f * angle - 4.0f * p.y);
  const float edge = radius + 0.017f * down * fold;
  float d = 0.8f * (std::hypot(p.x, 1.12f * p.z) - edge);  // 0.8: the folds steepen the field
  d = std::max(d, std::max(p.y - 0.95f, 0.012f - p.y));
  float knee = tapered_capsule(p, {-0.08f, 0.88f, 0.03f}, {-0.095f, 0.50f, 0.165f}, 0.095f, 0.072f);
  knee = smooth_union(
      knee, tapered_capsule(p, {-0.095f, 0.50f, 0.165f}, {-0.09f, 0.10f, 0.13f}, 0.070f, 0.055f), 0.05f);
  d = smooth_union(d, knee, 0.09f);
  for (const float side : {-1.0f, 1.0f}) {
    const float forward = side < 0.0f ? 0.245f : 0.215f;
    d = smooth_union(d, ellipsoid(p, {0.095f * side, 0.028f, forward}, {0.045f, 0.036f, 0.085f}), 0.02f);
  }
  return d;
}

float cloak(const vec3& p) {
  // Over the left shoulder, across the breast to the right hip, and hanging from the left forearm.
  // Five strands side by side read as folds of one cloth.
  float d = 1.0f;
  for (int strand = -2; strand <= 2; ++strand) {
    const auto at = static_cast<float>(strand);
    const vec3 beside = at * vec3(0.017f, 0.013f, -0.003f * at);
    const vec3 shoulder = vec3(0.150f, 1.402f, -0.01f) + 0.8f * beside;
    const vec3 breast = vec3(0.085f, 1.275f, 0.128f) + beside,
               hip = vec3(-0.150f, 0.965f, 0.090f) + 1.3f * beside;
    const vec3 back = vec3(-0.04f, 1.02f, -0.115f) + 1.4f * at * vec3(0.017f, -0.013f, 0.0f);
    d = smooth_union(d, tapered_capsule(p, shoulder, breast, 0.018f, 0.016f), 0.012f);
    d = smooth_union(d, tapered_capsule(p, breast, hip, 0.016f, 0.020f), 0.012f);
    d = smooth_union(d, tapered_capsule(p, shoulder, back, 0.020f, 0.026f), 0.016f);
  }
  const vec3 hem = (p - vec3(0.205f, 0.0f, 0.095f)) * vec3(1.0f, 1.0f, 0.62f);
  const float pleats = 0.010f * std::sin(95.0f * p.z + 3.0f * std::sin(5.0f * p.y));
  const float fall =
      0.75f * (tapered_capsule(hem, {0, 1.02f, 0}, {0.03f, 0.36f, 0.0f}, 0.038f, 0.062f) + pleats);
  d = smooth_union(d, std::max(fall, 0.34f - p.y), 0.03f);
  return d;
}

float figure(const vec3& p) {
  const float body = smooth_union(smooth_union(trunk(p), skirt(p), 0.07f), arms(p), 0.025f);
  return std::min(smooth_union(body, cloak(p), 0.022f),
                  ellipsoid(p, {0, 0.0f, 0.02f}, {0.33f, 0.035f, 0.33f}));
}

Mesh plinth() {
  Mesh mesh;
  const auto slab = [&](float half, float from, float to) {
    append(mesh, box({-half, from, -half}, {half, to, half}, 1.0f), glm::mat4(1.0f));
  };
  slab(0.34f, 0.00f, 0.08f);
  slab(0.31f, 0.08f, 0.11f);
  slab(0.28f, 0.11f, 0.29f);
  slab(0.31f, 0.29f, 0.32f);
  slab(0.33f, 0.32f, 0.36f);
  return mesh;
}

}  // namespace

GlbObject statue() {
  const Mesh body = surface_nets(figure, {{-0.46f, -0.06f, -0.38f}, {0.40f, 2.08f, 0.40f}, kCellM});
  Mesh mesh;
  const Mesh detail = surface_nets(head, {{-0.12f, 1.38f, -0.19f}, {0.12f, 1.76f, 0.15f}, kHeadCellM});
  const glm::mat4 on_plinth = glm::translate(glm::mat4(1.0f), vec3(0.0f, 0.375f, 0.0f));
  append(mesh, body, on_plinth);
  // A part of the marble without veins: one across the face would read as a scar.
  append(mesh, detail, on_plinth, {{0.547f, 0.266f}, {0.664f, 0.441f}});
  append(mesh, plinth(), glm::mat4(1.0f));
  return {"statue", {{mesh, {"marble", vec3(1.0f), 0.0f, 0.5f, {}, marble_picture()}}}};
}

}  // namespace herr::samples
