// What a renderer says it holds in memory, and that a scene's plan is what it allocates by.
#include "renderer/memory_use.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include "scenes/changes/world.h"
#include "scenes/model/placed_objects.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

// Matte triangles under one light without extent.
Scene plain_scene() {
  Scene scene;
  test::add(scene, test::floor_quad(5, -1), test::matte({0.5f, 0.4f, 0.3f}));
  test::add(scene, test::sphere({0.3f, 0, -3}, 0.8f), test::matte({0.2f, 0.7f, 0.9f}));
  scene.lights = {test::light_at({1, 3, -1}, {20, 15, 10})};
  return scene;
}

std::int64_t bytes_for(const Renderer& renderer, const std::string& name) {
  for (const MemoryEntry& entry : renderer.memory()) {
    if (entry.name == name) return entry.bytes;
  }
  ADD_FAILURE() << "no entry '" << name << "'";
  return -1;
}

std::int64_t bytes_for(const Scene& scene, const std::string& name, const RenderSettings& settings) {
  return bytes_for(Renderer(scene, test::small_profile(), settings, false), name);
}

TEST(MemoryUseTest, PlainTrianglesUnderOneHardLightHaveNoMemoryForAnythingElse) {
  const Scene scene = plain_scene();
  const Renderer renderer(scene, test::small_profile(), test::small_settings(), false);
  for (const char* name : {"probes", "voxels", "textures", "second rays", "catcher shadow rays",
                           "alpha layers", "adaptive light samples"}) {
    EXPECT_EQ(bytes_for(renderer, name), 0) << name;
  }
  for (const char* name : {"acceleration structures", "surfaces", "radiance buffers", "tiles in work"}) {
    EXPECT_GT(bytes_for(renderer, name), 0) << name;
  }
}

TEST(MemoryUseTest, EachPartIsThereWhereTheSceneAsksForIt) {
  RenderSettings settings = test::small_settings();
  Scene mirror = plain_scene();
  mirror.materials[0].mirror = 0.5f;
  EXPECT_GE(bytes_for(mirror, "second rays", settings), static_cast<std::int64_t>(1024 * 4 * 40));
  Scene glass = plain_scene();
  glass.materials[0].transmission = 1;
  EXPECT_GT(bytes_for(glass, "second rays", settings), 0);
  Scene textured = plain_scene();
  textured.textures.push_back({"grey", 64, 64, true, {}, {}, std::vector<std::uint8_t>(64 * 64 * 4, 128)});
  textured.materials[0].base_colour_texture = 0;
  // 64^2 + 32^2 + ... + 1 texels of four bytes, and what says where they are.
  EXPECT_NEAR(static_cast<double>(bytes_for(textured, "textures", settings)), 5461 * 4, 1024);
  Scene catchers = plain_scene();
  catchers.instances[0].catcher = catchers.instances[1].catcher = true;
  EXPECT_GT(bytes_for(catchers, "catcher shadow rays", settings), 0);
  Scene blended = plain_scene();
  blended.materials[1].alpha_mode = AlphaMode::blend;
  blended.materials[1].alpha = 0.5f;
  EXPECT_GT(bytes_for(blended, "alpha layers", settings), 0);
  settings.probes.on = true;
  // 8 x 8 x 8 probes of 240 floats at least.
  EXPECT_GT(bytes_for(plain_scene(), "probes", settings), 8 * 8 * 8 * 240 * 4);
  settings = test::small_settings();
  settings.light_samples = 16;
  settings.adaptive_min_samples = 4;
  EXPECT_GT(bytes_for(plain_scene(), "adaptive light samples", settings), 0);
}

TEST(MemoryUseTest, WhatItSaysIsWhatTheHeapHasLost) {
  // Embree maps part of its memory past the heap, so its entry is left out; what it takes from the heap is
  // small here. Buffers of 2 x 600 x 400 texels stand against it.
  RenderSettings settings = test::small_settings();
  settings.polar_width = 600;
  settings.polar_height = 400;
  const Scene scene = plain_scene();
  { const Renderer warm_up(scene, test::small_profile(), settings, false); }
  const auto heap = [] {
    const struct mallinfo2 now = mallinfo2();
    return static_cast<std::int64_t>(now.uordblks + now.hblkhd);
  };
  const std::int64_t before = heap();
  const Renderer renderer(scene, test::small_profile(), settings, false);
  const double taken = static_cast<double>(heap() - before);
  const double said =
      static_cast<double>(total_bytes(renderer.memory()) - bytes_for(renderer, "acceleration structures"));
  EXPECT_LE(said, taken);
  EXPECT_GE(said, 0.8 * taken);
}

TEST(MemoryUseTest, ASceneThatComesToNeedMoreGetsIt) {
  // A pane of glass that is not there at first: its layers and second rays are allocated when it comes.
  Scene scene = plain_scene();
  Material pane = test::matte({0.2f, 0.4f, 0.9f});
  pane.alpha_mode = AlphaMode::blend;
  pane.alpha = 0.5f;
  pane.mirror = 0.5f;
  test::add(scene, test::quad({-1, -1, -2}, {2, 0, 0}, {0, 2, 0}), pane);
  scene.instances[2].present = false;
  complete_objects(scene);
  World world(scene);
  Renderer renderer(scene, test::small_profile(), test::small_settings(), false);
  EXPECT_EQ(bytes_for(renderer, "alpha layers"), 0);
  EXPECT_EQ(bytes_for(renderer, "second rays"), 0);
  RenderedFrame frame;
  renderer.render_frame(test::sample_from({0, 0, 0}), world.state(), frame);
  SceneChange spawn;
  spawn.kind = ChangeKind::spawn;
  spawn.of = "instance 2";
  spawn.name = "pane";
  ASSERT_FALSE(world.apply(spawn));
  world.advance(0);
  renderer.render_frame(test::sample_from({0, 0, 0}), world.state(), frame);
  EXPECT_EQ(frame.counters.plan_changes, 1);
  EXPECT_GT(frame.counters.rays[RayKind::behind], 0);
  EXPECT_GT(bytes_for(renderer, "alpha layers"), 0);
  EXPECT_GT(bytes_for(renderer, "second rays"), 0);
}

}  // namespace
}  // namespace herr
