// Frames of a scene whose meshes have coarser forms: which is shown when, what it costs, what it changes.
#include "renderer/detail/detail_levels.h"

#include <gtest/gtest.h>

#include "scenes/detail/simplify_mesh.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

// A ball of radius 0.5 m and 32,768 triangles, 2 m ahead.
Scene ball_scene(bool with_forms) {
  Scene scene;
  test::add(scene, test::sphere({0, 0, -2}, 0.5f, 128, 128), test::matte(glm::vec3{0.6f}));
  scene.lights = {test::light_at({2, 3, 1}, {20, 20, 20})};
  scene.ambient = glm::vec3(0.1f);
  if (with_forms) add_coarser_meshes(scene, 0);
  return scene;
}

SceneState state_of(const Scene& scene) {
  SceneState state;
  scene_state_at(scene, 0, state);
  return state;
}

FrameSample looking(const glm::dvec3& from, const glm::dvec3& gaze) {
  return test::sample_from(from, gaze);
}

// On which level the only instance that has a choice is shown.
int level_of(const Renderer& renderer) {
  return static_cast<int>(renderer.state().details.at(0));
}

TEST(DetailLevels, OnlyAChangeOfTheFormIsCommitted) {
  const Scene scene = ball_scene(true);
  const SceneState state = state_of(scene);
  Renderer renderer(scene, test::small_profile(), test::small_settings(), false);
  RenderedFrame frame;
  renderer.render_frame(looking({0, 0, 0}, {0, 0, -1}), state, frame);
  const int near = level_of(renderer);
  renderer.render_frame(looking({0, 0, 0}, {0, 0, -1}), state, frame);
  EXPECT_EQ(frame.counters.commits, 0);
  EXPECT_EQ(level_of(renderer), near);
  renderer.render_frame(looking({0, 0, 20}, {0, 0, -1}), state, frame);
  EXPECT_EQ(frame.counters.commits, 1);
  const int far = level_of(renderer);
  EXPECT_GT(far, near) << "22 m away";
  renderer.render_frame(looking({0, 0, 0}, {0, 0, -1}), state, frame);
  EXPECT_LT(level_of(renderer), far) << "back again";
  EXPECT_LE(level_of(renderer), near + 1) << "at most the width between the two bounds from where it was";
}

TEST(DetailLevels, AnObjectBesideTheGazeIsCoarserThanOneInIt) {
  const Scene scene = ball_scene(true);
  const SceneState state = state_of(scene);
  RenderedFrame frame;
  Renderer at(scene, test::small_profile(), test::small_settings(), false);
  at.render_frame(looking({0, 0, 0}, {0, 0, -1}), state, frame);
  Renderer beside(scene, test::small_profile(), test::small_settings(), false);
  beside.render_frame(looking({0, 0, 0}, {1, 0, -0.4}), state, frame);
  EXPECT_GT(level_of(beside), level_of(at));
}

TEST(DetailLevels, APictureOfCoarserFormsIsNearlyThatOfTheFullMesh) {
  // A surface off by half a sample moves its silhouette by half a sample, which is a thin line of pixels;
  // inside it normals are interpolated from the same vertices' normals and shading changes by little. Mean
  // over all pixels: the ball covers a few percent of the picture, its rim a few percent of that.
  const Scene full = ball_scene(false), scene = ball_scene(true);
  Renderer reference(full, test::small_profile(), test::small_settings(), false);
  Renderer renderer(scene, test::small_profile(), test::small_settings(), false);
  RenderedFrame expected, frame;
  for (const double z : {0.0, 4.0, 20.0}) {
    reference.render_frame(looking({0, 0, z}, {0, 0, -1}), state_of(full), expected);
    renderer.render_frame(looking({0, 0, z}, {0, 0, -1}), state_of(scene), frame);
    EXPECT_LT(test::mean_difference(frame, expected), 0.002) << "from z = " << z;
  }
  EXPECT_GT(level_of(renderer), 0);
}

TEST(DetailLevels, WithoutAllowedErrorEveryFrameShowsTheFullMesh) {
  const Scene full = ball_scene(false), scene = ball_scene(true);
  RenderSettings settings = test::small_settings();
  RenderedFrame frame;
  for (const double z : {0.0, 20.0, 200.0}) {
    settings.detail_error = 0.5;
    Renderer renderer(scene, test::small_profile(), settings, false);
    renderer.render_frame(looking({0, 0, z}, {0, 0, -1}), state_of(scene), frame);
    EXPECT_TRUE(z == 0 || level_of(renderer) > 0) << z;
    settings.detail_error = 0;
    Renderer exact(scene, test::small_profile(), settings, false);
    exact.render_frame(looking({0, 0, z}, {0, 0, -1}), state_of(scene), frame);
    EXPECT_EQ(level_of(exact), 0) << z;
    test::expect_same_bits(
        frame, test::render(full, test::small_profile(), settings, looking({0, 0, z}, {0, 0, -1})));
  }
}

TEST(DetailLevels, ARendererGoesOnWithTheFormsOfAnother) {
  // Between its two bounds a form depends on the one before: so it is part of the renderer's state.
  const Scene scene = ball_scene(true);
  const SceneState state = state_of(scene);
  RenderedFrame frame, expected;
  Renderer one(scene, test::small_profile(), test::small_settings(), false);
  for (const double z : {20.0, 12.0, 9.0}) one.render_frame(looking({0, 0, z}, {0, 0, -1}), state, frame);
  const RendererState saved = one.state();
  one.render_frame(looking({0, 0, 8.5}, {0, 0, -1}), state, expected);
  Renderer other(scene, test::small_profile(), test::small_settings(), false);
  other.restore(saved);
  other.render_frame(looking({0, 0, 8.5}, {0, 0, -1}), state, frame);
  test::expect_same_bits(frame, expected);
  EXPECT_EQ(other.state().details, one.state().details);

  RendererState of_another = saved;
  of_another.details.push_back({});
  EXPECT_THROW(other.restore(of_another), std::invalid_argument);
  of_another.details = {std::byte{200}};
  EXPECT_THROW(other.restore(of_another), std::invalid_argument);
}

TEST(DetailLevels, AScaledAndTurnedInstanceIsMeasuredInTheWorld) {
  Scene scene = ball_scene(true);
  scene.instances[0].world_from_object = glm::dmat4x3{{0, 0, -10}, {0, 10, 0}, {10, 0, 0}, {0, 0, 0}};
  DetailLevels levels(scene);
  DetailEye eye;
  eye.position = {0, 0, 5};  // the ball about (0, 0, -2) * turned and ten times as large: about (-20, 0, 0)
  int shown = 0;
  const auto world_from = [&](std::size_t i) -> const glm::dmat4x3& {
    return scene.instances[i].world_from_object;
  };
  levels.choose(std::span(&eye, 1), 0.5, world_from, [&](std::size_t, std::uint32_t) { ++shown; });
  const int beside = static_cast<int>(levels.save().at(0));
  eye.position = {-20, 0, 2};  // within it
  levels.choose(std::span(&eye, 1), 0.5, world_from, [&](std::size_t, std::uint32_t) { ++shown; });
  EXPECT_EQ(static_cast<int>(levels.save().at(0)), 0);
  EXPECT_GT(beside, 0);
  EXPECT_EQ(shown, 2);
}

}  // namespace
}  // namespace herr
