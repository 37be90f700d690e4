// Clear smooth glass of index 1.5, as tests of light in glass use it.
#pragma once

#include "tests/renderer/test_scenes.h"

namespace herr::test {

inline constexpr float kGlassIndex = 1.5f;
inline constexpr double kGlassHeadOn = 0.04;  // Fresnel head on: ((n - 1) / (n + 1))^2

inline Material clear_glass() {
  Material m = matte(glm::vec3{1.0f});
  m.roughness = 0;
  m.transmission = 1;
  m.mirror = 1;
  m.refractive_index = kGlassIndex;
  return m;
}

}  // namespace herr::test
