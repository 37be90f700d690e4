// Objects on paths: their frames are those of scenes that were loaded with the object where it is then.
#include <gtest/gtest.h>

#include "scenes/changes/world.h"
#include "tests/renderer/geometry/changing_scenes.h"

namespace herr::test {
namespace {

// The ball goes from where it stands to (0.5, 0.25, -2), rests there, and comes back twice as large.
Scene world_with_path() {
  Scene scene = small_world();
  ObjectPath& path = scene.objects[1].path;
  path.keys = {{0, {{0, 0, -3}}}, {1, {{0.5, 0.25, -2}}}, {2, {{0.5, 0.25, -2}}}, {4, {{0, 0, -3}}}};
  path.keys.back().placement.scale = glm::dvec3(2.0);
  scene.changes = true;
  return scene;
}

TEST(ObjectPathFramesTest, AFrameOnAPathIsThatOfASceneLoadedAtThatInstant) {
  // Each number is exact in binary: so is the picture.
  const struct {
    double time_s;
    glm::dvec3 place;
    double scale;
    int moved;  // against the row before
  } rows[] = {{0, {0, 0, -3}, 1, 0},      {0.25, {0.125, 0.0625, -2.75}, 1, 1},
              {1, {0.5, 0.25, -2}, 1, 1}, {1.7, {0.5, 0.25, -2}, 1, 0},
              {2, {0.5, 0.25, -2}, 1, 0}, {3, {0.25, 0.125, -2.5}, 1.5, 1},
              {4, {0, 0, -3}, 2, 1},      {99, {0, 0, -3}, 2, 0}};
  const FrameSample sample = sample_from({0, 0, 0}, {0.1, -0.1, -1});
  for (const int threads : {1, 2, 4}) {
    Scene scene = world_with_path();
    World world(scene);
    Renderer renderer(scene, small_profile(), with_threads(threads), false);
    RenderedFrame frame;
    bool first = true;
    for (const auto& [time_s, place, scale, moved] : rows) {
      SCOPED_TRACE(testing::Message() << threads << " threads, " << time_s << " s");
      world.advance(time_s);
      renderer.render_frame(sample, world.state(), frame);
      EXPECT_EQ(frame.counters.instances_moved, moved);
      EXPECT_EQ(frame.counters.commits, first ? 1 : moved);  // the first places the anchor
      EXPECT_EQ(frame.counters.instances_spawned + frame.counters.instances_removed, 0);
      first = false;
      Scene there = small_world();
      there.instances[1].world_from_object =
          glm::scale(glm::translate(glm::dmat4(1.0), place), glm::dvec3(scale));
      expect_same_bits(frame, fresh(there, world.state(), with_threads(threads), sample));
    }
  }
}

}  // namespace
}  // namespace herr::test
