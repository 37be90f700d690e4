// Direct light on a surface point in double, written out from the papers: what the kernels are held against.
// GGX: Walter et al. 2007; joint visibility: Hammon 2017 (PBR diffuse for GGX), Schlick's Fresnel.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "scenes/model/scene.h"

namespace herr::test {

struct SurfacePoint {
  glm::dvec3 position, normal, to_viewer;  // unit vectors
};

// Radiance towards the viewer per unit of radiance x cosine received from `to_light` (unit).
inline glm::dvec3 brdf(const Material& m, const SurfacePoint& at, const glm::dvec3& to_light) {
  const glm::dvec3 base(m.base_colour);
  const double metallic = m.metallic, alpha = std::max(double{m.roughness} * m.roughness, 1e-3);
  const glm::dvec3 f0 = glm::dvec3{0.04} * (1 - metallic) + base * metallic;
  const glm::dvec3 h = glm::normalize(to_light + at.to_viewer);
  const double n_l = glm::dot(at.normal, to_light), n_v = std::abs(glm::dot(at.normal, at.to_viewer));
  const double n_h = glm::dot(at.normal, h), l_h = glm::dot(to_light, h);
  const double denominator = n_h * n_h * (alpha * alpha - 1) + 1;
  const double lobe = alpha * alpha / (glm::pi<double>() * denominator * denominator);
  const double visibility = 0.5 / (alpha * (n_l + n_v) + (1 - alpha) * 2 * n_l * n_v);
  const glm::dvec3 fresnel = f0 + (1.0 - f0) * std::pow(1 - l_h, 5);
  return base * (1 - metallic) / glm::pi<double>() + fresnel * (lobe * visibility);
}

// Unshadowed radiance by a point of the light with the falloff's floor min_distance.
inline glm::dvec3 radiance_from(const Material& m, const SurfacePoint& at, const glm::dvec3& point,
                                const glm::dvec3& intensity, double min_distance) {
  const glm::dvec3 to_light = point - at.position;
  const double distance = glm::length(to_light);
  const glm::dvec3 direction = to_light / distance;
  const double n_l = glm::dot(at.normal, direction);
  if (n_l <= 0) return glm::dvec3{0.0};
  const double floor = std::max(distance, min_distance);
  return brdf(m, at, direction) * intensity * (n_l / (floor * floor));
}

// The light's whole box by four Gauss-Legendre points per axis: exact for polynomials of degree 7. Across a
// box no larger than its distance from the point the error is below 1e-4.
inline glm::dvec3 radiance_from_box(const Material& m, const SurfacePoint& at, const AreaLight& light) {
  constexpr double kNode[4] = {-0.861136311594053, -0.339981043584856, 0.339981043584856, 0.861136311594053};
  constexpr double kWeight[4] = {0.347854845137454, 0.652145154862546, 0.652145154862546, 0.347854845137454};
  const glm::dvec3 half = 0.5 * glm::dvec3(light.size);
  const double min_distance = std::max({half.x, half.y, half.z});
  glm::dvec3 sum{0.0};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) {
        const glm::dvec3 point = light.centre + glm::dvec3{kNode[i], kNode[j], kNode[k]} * half;
        sum += kWeight[i] * kWeight[j] * kWeight[k] *
               radiance_from(m, at, point, glm::dvec3(light.intensity_w_sr), min_distance);
      }
    }
  }
  return sum / 8.0;
}

}  // namespace herr::test
