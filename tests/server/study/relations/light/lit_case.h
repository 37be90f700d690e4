// A floor, a blocker, a glass ball and a wall under a wide lamp: a case for relations of light.
#pragma once

#include "server/study/relations/relation_case.h"
#include "tests/renderer/test_scenes.h"

namespace herr::test {

inline Scene lit_scene() {
  Scene scene;
  scene.name = "lit";
  add(scene, floor_quad(4), matte({0.6f, 0.5f, 0.4f}));
  add(scene, quad({-4, 0, -4}, {8, 0, 0}, {0, 4, 0}), matte({0.3f, 0.5f, 0.6f}));
  add(scene, box({-0.8f, 0.3f, -2.4f}, {-0.2f, 0.9f, -1.8f}), matte({0.8f, 0.8f, 0.8f}));
  Material glass = matte({1, 1, 1});
  glass.roughness = 0;
  glass.transmission = 1;
  add(scene, sphere({0.7f, 0.6f, -2}, 0.4f), glass);
  scene.lights = {light_at({0, 2.5, -1.5}, {12, 11, 10}, {1.2f, 0.1f, 0.8f})};
  scene.ambient = {0.1f, 0.1f, 0.1f};
  scene.environment = {0.3f, 0.4f, 0.5f};
  return scene;
}

inline RelationCase case_of(Scene scene) {
  RelationCase subject;
  subject.scene = std::move(scene);
  scene_state_at(subject.scene, 0.0, subject.state);
  subject.sample = sample_from({0, 1.2, 0.5}, glm::normalize(glm::dvec3(0, -0.3, -1)));
  subject.profile = small_profile(40, 48, 32);
  subject.settings = small_settings();
  subject.scene.probes.counts = {4, 2, 4};
  return subject;
}

}  // namespace herr::test
