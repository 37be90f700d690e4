// A slow path tracer in double precision for spheres in an environment picture or under a box lamp: what
// glossy surfaces are held against. It sums over the picture's bright texels, and for the rest draws
// directions from the lobe (visible normals, Heitz 2018, in the form of his paper), from the picture by its
// brightness and by the cosine, and weighs them by the balance heuristic (Veach); integrals that the renderer
// has tables for are sums over the same directions here.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "tests/renderer/reflectance/slow_sky.h"

namespace herr::test {

struct GlossBall {
  glm::dvec3 centre;
  double radius = 1;
  glm::dvec3 base{1.0};
  double roughness = 0, metallic = 0;
};

class SlowGloss {
 public:
  std::vector<GlossBall> balls;
  const SlowSky* sky = nullptr;   // none: it is dark outside
  std::optional<AreaLight> lamp;  // a box
  int samples = 768;              // of each kind of direction at the first hit

  // Radiance along a ray from the eye; `seed` tells its random numbers from those of others.
  glm::dvec3 radiance(const glm::dvec3& origin, const glm::dvec3& direction, std::uint32_t seed) const;

 private:
  struct Hit;
  // What a place sends back beside the lobe itself: the highlight's gain, and the share below it over pi.
  struct Scattering {
    bool mirror = false;
    glm::dvec3 gain, diffuse;
  };
  std::optional<Hit> nearest(const glm::dvec3& origin, const glm::dvec3& direction, double farthest) const;
  glm::dvec3 arriving(const glm::dvec3& origin, const glm::dvec3& direction, std::uint32_t seed,
                      int depth) const;
  Scattering scattering_of(const Hit& hit, int depth) const;
  glm::dvec3 sent_back(const Hit& hit, const Scattering& by, const glm::dvec3& l) const;
  glm::dvec3 from_bright_texels(const Hit& hit, const Scattering& by) const;
  glm::dvec3 from_outside(const Hit& hit, std::uint32_t seed, int depth) const;
  glm::dvec3 from_lamp(const Hit& hit, std::uint32_t seed, int depth) const;
};

}  // namespace herr::test
