// A renderer that is given up in the middle of a frame, and one that goes on where another one stopped.
#include <gtest/gtest.h>

#include <atomic>

#include "renderer/threads/render_threads.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

Scene box_scene() {
  Scene scene;
  test::add(scene, test::box({-1, -1, -4}, {1, 1, -3}), test::matte(glm::vec3{0.5f}));
  scene.lights = {test::light_at({1, 3, -1}, {20, 15, 10}, {0.4f, 0.1f, 0.4f})};
  return scene;
}

FrameSample head_at(double x) {
  return test::sample_from({x, 0, 0}, {0, 0, -1});
}

SceneState state_of(const Scene& scene) {
  SceneState state;
  scene_state_at(scene, 0, state);
  return state;
}

TEST(RenderThreadsTest, NoJobBeginsOnceTheyAreAbandoned) {
  RenderThreads threads(2);
  std::atomic<bool> abandon{false};
  std::atomic<int> begun{0};
  const bool all = threads.run(
      1000,
      [&](int, int) {
        if (++begun == 10) abandon = true;
      },
      &abandon);
  EXPECT_FALSE(all);
  // The tenth job, and at most one that the other thread had begun meanwhile.
  EXPECT_GE(begun, 10);
  EXPECT_LE(begun, 11);
  EXPECT_TRUE(threads.run(5, [](int, int) {})) << "without a flag nothing is abandoned";
}

TEST(RendererStateTest, AnAbandonedFrameIsNoneAndTheNextOneIsWhole) {
  const Scene scene = box_scene();
  Renderer renderer(scene, test::small_profile(), test::small_settings(), false);
  const SceneState state = state_of(scene);
  RenderedFrame expected, frame;
  EXPECT_TRUE(renderer.render_frame(head_at(0), state, expected));
  std::atomic<bool> abandon{true};
  EXPECT_FALSE(renderer.render_frame(head_at(0.5), state, frame, &abandon));
  abandon = false;
  EXPECT_TRUE(renderer.render_frame(head_at(0), state, frame, &abandon));
  test::expect_same_bits(frame, expected);
}

TEST(RendererStateTest, ARendererGoesOnFromTheStateOfAnother) {
  const Scene scene = box_scene();
  const SceneState state = state_of(scene);
  Renderer one(scene, test::small_profile(), test::small_settings(), false);
  EXPECT_FALSE(one.state().anchor);
  RenderedFrame frame, expected;
  one.render_frame(head_at(0), state, frame);
  // 20 m from the anchor 0: within its reach of 24 m, though 16 is the nearest multiple.
  one.render_frame(head_at(20), state, frame);
  EXPECT_EQ(one.state().anchor, glm::dvec3(0));
  const RendererState at_20 = one.state();
  one.render_frame(head_at(21), state, expected);
  EXPECT_EQ(expected.counters.commits, 0);

  Renderer other(scene, test::small_profile(), test::small_settings(), false);
  other.restore(at_20);
  other.render_frame(head_at(21), state, frame);
  EXPECT_EQ(frame.counters.commits, 0);
  EXPECT_EQ(other.state().anchor, glm::dvec3(0));
  test::expect_same_bits(frame, expected);

  Renderer passed(scene, test::small_profile(), test::small_settings(), false);
  passed.skip_frame(head_at(0), state);
  passed.skip_frame(head_at(20), state);
  EXPECT_EQ(passed.state().anchor, glm::dvec3(0));
  Renderer fresh(scene, test::small_profile(), test::small_settings(), false);
  fresh.skip_frame(head_at(21), state);
  EXPECT_EQ(fresh.state().anchor, glm::dvec3(16, 0, 0)) << "without the past it lies elsewhere";
}

}  // namespace
}  // namespace herr
