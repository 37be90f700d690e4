// A scene that is grown or shrunk as a whole, eyes and lights with it, looks the same: no length in the
// renderer is absolute. Factors are no powers of two, so that every number rounds otherwise.
#include <gtest/gtest.h>

#include <vector>

#include "tests/renderer/half_pixels.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/scaled_scene.h"
#include "tests/renderer/voxels/voxel_grids.h"

namespace herr {
namespace {

constexpr double kAlike = 0.99;  // of the pixels; edges may round to the other side

Instance shape(Scene& scene, ShapeKind kind, const Material& material, const glm::dvec3& half,
               const glm::dvec3& centre) {
  Instance instance;
  instance.kind = kind;
  instance.material = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back(material);
  instance.world_from_object = {glm::dvec3{half.x, 0, 0}, glm::dvec3{0, half.y, 0}, glm::dvec3{0, 0, half.z},
                                centre};
  return instance;
}

Material mirror() {
  Material material = test::matte({0.9f, 0.8f, 0.7f});
  material.metallic = 1;
  material.roughness = 0.2f;
  material.mirror = 0.8f;
  return material;
}

Material glass() {
  Material material = test::matte(glm::vec3{1.0f});
  material.transmission = 1;
  material.roughness = 0.05f;
  return material;
}

Material textured() {
  Material material = test::matte(glm::vec3{1.0f});
  material.base_colour_texture = 0;
  return material;
}

// Room for everything that meets rays: triangles, shapes, voxels; matte, mirror, glass, texture; a light of
// some size, a spot that ends and a sun.
Scene furnished() {
  Scene scene;
  TextureImage checkers;
  checkers.width_px = checkers.height_px = 2;
  checkers.rgba = {220, 40, 60, 255, 40, 200, 60, 255, 40, 200, 60, 255, 220, 40, 60, 255};
  scene.textures.push_back(checkers);
  test::add(scene, test::floor_quad(4, -1), test::matte({0.5f, 0.4f, 0.3f}));
  test::add(scene, test::quad({-4, -1, -5}, {8, 0, 0}, {0, 4, 0}), test::matte({0.3f, 0.5f, 0.6f}));
  test::add(scene, test::box({-1.6f, -1, -3.4f}, {-0.7f, 0.1f, -2.6f}), textured());
  test::add(scene, test::sphere({0.2f, -0.5f, -2.5f}, 0.5f), mirror());
  test::add(scene, test::sphere({1.2f, -0.6f, -2.2f}, 0.4f), glass());
  scene.instances.push_back(shape(scene, ShapeKind::sphere, test::matte({0.7f, 0.3f, 0.3f}),
                                  glm::dvec3{0.3, 0.3, 0.4}, {-0.3, -0.7, -1.9}));
  scene.instances.push_back(
      shape(scene, ShapeKind::box, mirror(), glm::dvec3{0.2, 0.5, 0.1}, {1.9, -0.5, -3}));
  scene.voxel_grids.push_back(test::patched_ball(20, 3));
  Instance voxels =
      shape(scene, ShapeKind::voxels, test::matte(glm::vec3{1.0f}), glm::dvec3{0.05}, {-0.6, 0.3, -3.5});
  voxels.grid = 0;
  scene.instances.push_back(voxels);
  scene.lights = {test::light_at({1, 2.5, -1}, {12, 10, 8}, {0.5f, 0.1f, 0.5f})};
  AreaLight spot = test::light_at({-2, 2, -1}, {10, 12, 20});
  spot.kind = LightKind::spot;
  spot.direction = glm::normalize(glm::dvec3{0.5, -1, -0.7});
  spot.inner_cone_rad = 0.3, spot.outer_cone_rad = 0.6;
  spot.range_m = 6;
  scene.lights.push_back(spot);
  AreaLight sun = test::light_at({0, 0, 0}, {0.5f, 0.45f, 0.4f});
  sun.kind = LightKind::sun;
  sun.direction = glm::normalize(glm::dvec3{-0.3, -1, -0.4});
  scene.lights.push_back(sun);
  scene.environment = {0.2f, 0.25f, 0.3f};
  scene.ambient = glm::vec3{0.05f};
  return scene;
}

// A closed room, for probes: what is seen is mostly bounced. The box's left face lies in a plane of probes.
Scene closed_room() {
  Scene scene;
  TriangleMesh room = test::box({-2, -1, -4}, {2, 2, 1});
  for (auto& t : room.triangles) std::swap(t[1], t[2]);
  for (glm::vec3& n : room.normals) n = -n;
  test::add(scene, room, test::matte({0.7f, 0.6f, 0.5f}));
  test::add(scene, test::box({-1, -1, -3}, {0, 0.5f, -2}), test::matte({0.8f, 0.2f, 0.2f}));
  scene.lights = {test::light_at({1, 1.5, -1}, glm::vec3{4.0f}, {0.3f, 0.1f, 0.3f})};
  scene.probes.counts = {6, 4, 5};
  return scene;
}

// Stand-ins of a real room under virtual things.
Scene with_catchers() {
  Scene scene;
  test::add(scene, test::floor_quad(4, -1), test::matte(glm::vec3{0.5f}), true);
  test::add(scene, test::quad({-4, -1, -5}, {8, 0, 0}, {0, 4, 0}), test::matte(glm::vec3{0.4f}), true);
  test::add(scene, test::sphere({0, 0, -3}, 0.8f), mirror());
  scene.lights = {test::light_at({1, 3, -1}, {20, 15, 10}, {0.4f, 0.1f, 0.4f})};
  scene.environment = scene.ambient = glm::vec3{0.2f};
  return scene;
}

FrameSample two_eyes() {
  FrameSample sample = test::sample_from({0.13, 0.21, 0.37}, glm::normalize(glm::dvec3{0.1, -0.15, -1}));
  sample.head_from_eye[0].position = {-0.0315, 0, 0};
  sample.head_from_eye[1].position = {0.0315, 0, 0};
  return sample;
}

RenderSettings everything(Foveation foveation) {
  RenderSettings settings = test::small_settings();
  settings.foveation = foveation;
  settings.polar_width = 96, settings.polar_height = 96;
  settings.light_samples = 4;
  settings.occlusion_rays = 4;
  return settings;
}

RenderedFrame frame_of(const Scene& scene, const RenderSettings& settings, FrameSample sample, int frames) {
  Renderer renderer(scene, test::small_profile(64, 80, 48), settings, false);
  RenderedFrame out;
  for (int frame = 0; frame < frames; ++frame) {
    sample.t_ns += 16'666'667;
    test::render_with(renderer, scene, sample, out);
  }
  return out;
}

void expect_the_same_at_every_size(const Scene& scene, const RenderSettings& settings, int frames = 1,
                                   const std::vector<double>& factors = {1e-8, 1e-4, 0.03, 1e5}) {
  for (const Foveation foveation : {Foveation::log_polar, Foveation::off}) {
    RenderSettings own = settings;
    own.foveation = foveation;
    const RenderedFrame as_it_is = frame_of(scene, own, two_eyes(), frames);
    for (const double factor : factors) {
      for (const test::Growth growth : {test::Growth::by_nodes, test::Growth::by_vertices}) {
        const RenderedFrame other =
            frame_of(test::scaled_scene(scene, factor, growth), test::scaled_settings(own, factor),
                     test::scaled_sample(two_eyes(), factor), frames);
        EXPECT_EQ(other.counters.invalid_rays, 0);
        EXPECT_EQ(other.counters.nonfinite_values, 0);
        EXPECT_GE(test::share_alike(as_it_is, other), kAlike)
            << "factor " << factor << ", foveation " << static_cast<int>(foveation) << ", growth "
            << static_cast<int>(growth);
      }
    }
  }
}

// Twice as large is twice every number, exactly: what is not, is an absolute length.
TEST(ScaledSceneTest, PowersOfTwoChangeNoBit) {
  for (Scene scene : {furnished(), closed_room(), with_catchers()}) {
    scene.probes.counts = {4, 3, 5};
    RenderSettings settings = everything(Foveation::log_polar);
    settings.probes.on = true;
    settings.probes.rays = 32;
    const RenderedFrame as_it_is = frame_of(scene, settings, two_eyes(), 2);
    // Larger ones would move the anchor.
    for (const double factor : {0x1p-20, 0x1p-13, 2.0}) {
      const RenderedFrame other =
          frame_of(test::scaled_scene(scene, factor, test::Growth::by_nodes),
                   test::scaled_settings(settings, factor), test::scaled_sample(two_eyes(), factor), 2);
      test::expect_same_bits(as_it_is, other);
    }
  }
}

TEST(ScaledSceneTest, DirectLightMirrorsGlassShapesAndVoxelsLookTheSameAtEverySize) {
  expect_the_same_at_every_size(furnished(), everything(Foveation::off));
}

// A kilometre from the origin floats lie 6e-5 m apart, which is more than half of a scene of 1e-4 m.
TEST(ScaledSceneTest, WhatIsSmallLooksTheSameFarFromTheOrigin) {
  const RenderSettings settings = everything(Foveation::off);
  const RenderedFrame as_it_is = frame_of(furnished(), settings, two_eyes(), 1);
  for (const double factor : {1e-2, 1e-4, 1e-5}) {
    Similarity similarity;
    similarity.scale = factor;
    similarity.move = {801.3, 267.1, -534.7};
    const RenderedFrame other =
        frame_of(similar_scene(furnished(), similarity), test::scaled_settings(settings, factor),
                 test::scaled_sample(two_eyes(), factor), 1);
    EXPECT_GE(test::share_alike(as_it_is, other), kAlike) << "factor " << factor;
  }
}

TEST(ScaledSceneTest, AdaptiveLightSamplesTakeTheSameDecisionsAtEverySize) {
  RenderSettings settings = everything(Foveation::off);
  settings.light_samples = 16;
  settings.adaptive_min_samples = 4;
  expect_the_same_at_every_size(furnished(), settings);
}

TEST(ScaledSceneTest, LightInProbesIsTheSameAtEverySize) {
  RenderSettings settings = everything(Foveation::off);
  settings.probes.on = true;
  settings.probes.rays = 16;
  expect_the_same_at_every_size(closed_room(), settings, 3, {1e-4, 1e5});
}

TEST(ScaledSceneTest, CatchersReceiveTheSameAtEverySize) {
  expect_the_same_at_every_size(with_catchers(), everything(Foveation::off));
}

}  // namespace
}  // namespace herr
