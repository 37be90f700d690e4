// A matrix that stretches: textures are read as finely as on the mesh that has the stretch in its vertices.
#include <gtest/gtest.h>

#include "tests/renderer/half_pixels.h"
#include "tests/renderer/scaled_scene.h"

namespace herr {
namespace {

// A texture of 128 x 128 in noise of two colours, whose alpha goes up along x: every level looks different.
TextureImage speckles() {
  TextureImage texture;
  texture.width_px = texture.height_px = 128;
  std::uint32_t state = 7;
  for (int i = 0; i < 128 * 128; ++i) {
    state = state * 1664525u + 1013904223u;
    const auto value = static_cast<std::uint8_t>((state >> 24 & 1u) != 0 ? 230 : 30);
    texture.rgba.insert(texture.rgba.end(),
                        {value, 128, value, static_cast<std::uint8_t>(state >> 25 & 255u)});
  }
  return texture;
}

// A square of 2 m, three metres ahead, whose texels are near a pixel wide.
RenderedFrame square(const glm::vec3& in_vertices, const glm::dvec3& in_matrix, AlphaMode alpha) {
  Scene scene;
  scene.textures.push_back(speckles());
  Material material = test::matte(glm::vec3{1.0f});
  material.base_colour_texture = 0;
  material.alpha_mode = alpha;
  TriangleMesh mesh = test::quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  for (glm::vec3& p : mesh.positions) p *= in_vertices;
  const glm::dvec3& s = in_matrix;
  test::add(scene, mesh, material, false,
            {glm::dvec3{s.x, 0, 0}, glm::dvec3{0, s.y, 0}, glm::dvec3{0, 0, s.z}, {0, 0, -3}});
  scene.ambient = glm::vec3{1.0f};
  scene.environment = {0.0f, 0.0f, 0.3f};
  RenderSettings settings = test::planar_settings();
  return test::render(scene, test::single_view(96, 96, 25, 25), settings, test::sample_from({0, 0, 0}));
}

// The square lies in z = 0: however the matrix stretches along z, it is the same square in the same place.
// Along x and y, vertices that are half as far out stand for twice the scale.
TEST(StretchedTextureTest, ReadsTheLevelOfTheSurfaceThatIsSeen) {
  for (const AlphaMode alpha : {AlphaMode::opaque, AlphaMode::mask}) {
    const RenderedFrame even = square({1, 1, 1}, {1, 1, 1}, alpha);
    for (const double depth : {0.01, 100.0})
      EXPECT_GE(test::share_alike(even, square({1, 1, 1}, {1, 1, depth}, alpha)), 0.99) << depth;
    EXPECT_GE(test::share_alike(even, square({0.25f, 1, 1}, {4, 1, 1}, alpha)), 0.99);
    EXPECT_GE(test::share_alike(even, square({0.25f, 8, 1}, {4, 0.125, 3}, alpha)), 0.99);
  }
}

}  // namespace
}  // namespace herr
