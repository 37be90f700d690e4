// A small scene whose objects have names, the picture of a scene that was loaded as it stands now,
// and how long changes take. Before: a test changes the scene. After: it compares frames bit for
// bit, or medians of times.
#pragma once

#include <algorithm>

#include "renderer/geometry/embree_scene.h"
#include "renderer/timing.h"
#include "scenes/model/placed_objects.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr::test {

inline RenderSettings with_threads(int threads) {
  RenderSettings settings = small_settings();
  settings.threads = threads;
  return settings;
}

// A floor, a ball and a block that is not there yet, by the names "instance 0", "1", "2".
inline Scene small_world() {
  Scene scene;
  add(scene, floor_quad(4, -1), matte(glm::vec3{0.6f}));
  add(scene, sphere({0, 0, 0}, 0.5f), matte({0.8f, 0.3f, 0.2f}), false,
      glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -3)));
  add(scene, box({-0.3f, -0.3f, -0.3f}, {0.3f, 0.3f, 0.3f}), matte({0.2f, 0.5f, 0.8f}));
  scene.instances.back().present = false;
  scene.lights = {light_at({1, 3, -1}, {20, 15, 10}, {0.4f, 0.1f, 0.4f})};
  complete_objects(scene);
  return scene;
}

// What a renderer shows that never saw another state of the scene.
inline RenderedFrame fresh(const Scene& scene, const SceneState& state, const RenderSettings& settings,
                           const FrameSample& sample) {
  Scene copy = scene;
  copy.instances.erase(std::remove_if(copy.instances.begin(), copy.instances.end(),
                                      [](const Instance& instance) { return !instance.present; }),
                       copy.instances.end());
  SceneState lights;
  lights.lights = state.lights;
  Renderer renderer(copy, small_profile(), settings, false);
  RenderedFrame frame;
  renderer.render_frame(sample, lights, frame);
  return frame;
}

inline SceneUpdate bring_up_to_date(EmbreeScene& geometry, const SceneState& state) {
  SceneUpdate update;
  geometry.follow(glm::dvec3(0.0));
  geometry.apply(state, update);
  geometry.commit_changes(update);
  return update;
}

}  // namespace herr::test
