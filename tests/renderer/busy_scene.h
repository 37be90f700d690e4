// One scene that gives every kernel work, and a camera feed to put behind it.
// Before: test_scenes.h. After: tests of what must not change a single bit.
#pragma once

#include "tests/renderer/half_pixels.h"
#include "tests/renderer/test_scenes.h"

namespace herr::test {

inline TextureImage checkers() {
  TextureImage texture;
  texture.width_px = texture.height_px = 8;
  for (int i = 0; i < 64; ++i) {
    const auto value = static_cast<std::uint8_t>((i / 8 + i) % 2 == 0 ? 220 : 40);
    texture.rgba.insert(texture.rgba.end(), {value, static_cast<std::uint8_t>(3 * i), value, 255});
  }
  return texture;
}

// Mirrors, textures, a catcher under coloured lights of some size: every kernel has work.
inline Scene busy_scene() {
  Scene scene;
  scene.textures.push_back(checkers());
  Material textured = matte(glm::vec3{1.0f});
  textured.base_colour_texture = 0;
  Material mirror = matte({0.9f, 0.8f, 0.7f});
  mirror.metallic = 1;
  mirror.roughness = 0.2f;
  mirror.mirror = 0.8f;
  add(scene, floor_quad(5, -1), matte(glm::vec3{0.5f}), true);
  add(scene, box({-1.5f, -1, -3}, {-0.5f, 0.3f, -2}), textured);
  add(scene, sphere({0.6f, 0, -3}, 0.8f), mirror);
  scene.lights = {light_at({1, 3, -1}, {20, 15, 10}, {0.4f, 0.1f, 0.4f}),
                  light_at({-2, 2, 0}, {2, 4, 8}, {0, 0.5f, 0})};
  scene.ambient = {0.1f, 0.12f, 0.15f};
  scene.environment = glm::vec3{0.3f};
  return scene;
}

inline TestCamera gradient_camera() {
  return TestCamera::pinhole(64, 48, 50, [](int x, int y) {
    return std::array<std::uint16_t, 4>{to_half(0.01 * x), to_half(0.02 * y), to_half(0.3), 0x3c00};
  });
}

}  // namespace herr::test
