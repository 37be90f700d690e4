#include "scenes/model/similar_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>

#include "scenes/model/transform_checks.h"

namespace herr {
namespace {

glm::dmat3 sizes_only(const glm::dmat3& turn) {
  return {glm::abs(turn[0]), glm::abs(turn[1]), glm::abs(turn[2])};
}

bool turns_by_quarters(const glm::dmat3& turn) {
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      const double entry = std::abs(turn[column][row]);
      if (entry != 0 && entry != 1) return false;
    }
  }
  return glm::determinant(turn) == 1;
}

glm::dvec3 place_of(const glm::dvec3& place, const Similarity& similarity) {
  return similarity.scale * (similarity.turn * place) + similarity.move;
}

glm::dmat4x3 matrix_of(const glm::dmat4x3& m, const Similarity& similarity) {
  glm::dmat4x3 out;
  for (int axis = 0; axis < 3; ++axis) out[axis] = similarity.scale * (similarity.turn * m[axis]);
  out[3] = place_of(m[3], similarity);
  return out;
}

Bounds box_of(const Bounds& box, const Similarity& similarity) {
  const glm::dvec3 a = place_of(box.lower, similarity), b = place_of(box.upper, similarity);
  return {glm::min(a, b), glm::max(a, b)};
}

// Degrees counter-clockwise about the up axis.
double turn_about_up_deg(const glm::dmat3& turn) {
  const glm::dvec3 east = turn * glm::dvec3(1, 0, 0);
  if (east.x != 0) return east.x > 0 ? 0 : 180;
  return east.z < 0 ? 90 : 270;
}

}  // namespace

glm::dmat3 quarter_turn(int axis) {
  glm::dmat3 turn(0.0);
  turn[axis][axis] = 1;
  turn[(axis + 1) % 3][(axis + 2) % 3] = 1;
  turn[(axis + 2) % 3][(axis + 1) % 3] = -1;
  return turn;
}

std::string why_not_similar(const Scene& scene, const Similarity& similarity) {
  const glm::dvec3 up = similarity.turn * glm::dvec3(0, 1, 0);
  if (!scene.environment_map.rgba.empty() && up.y != 1)
    return "the environment is a picture, which turns about the up axis alone";
  for (const Instance& instance : scene.instances) {
    const auto problem = transform_problem(matrix_of(instance.world_from_object, similarity));
    if (problem) return "instance '" + instance.name + "' then " + *problem;
  }
  return {};
}

AreaLight similar_light(AreaLight light, const Similarity& similarity) {
  light.centre = place_of(light.centre, similarity);
  light.size = glm::vec3(similarity.scale * (sizes_only(similarity.turn) * glm::dvec3(light.size)));
  light.direction = similarity.turn * light.direction;
  light.range_m *= similarity.scale;
  light.path_radius_m *= similarity.scale;
  if (light.kind == LightKind::sun) return light;
  light.intensity_w_sr = glm::vec3(similarity.scale * similarity.scale * glm::dvec3(light.intensity_w_sr));
  return light;
}

Scene similar_scene(Scene scene, const Similarity& similarity) {
  if (!turns_by_quarters(similarity.turn)) throw std::invalid_argument("not a turn by quarters");
  for (Instance& instance : scene.instances) {
    instance.world_from_object = matrix_of(instance.world_from_object, similarity);
  }
  for (AreaLight& light : scene.lights) light = similar_light(std::move(light), similarity);
  for (Material& material : scene.materials) {
    material.attenuation.distance_m =
        static_cast<float>(similarity.scale * double{material.attenuation.distance_m});
  }
  const glm::dvec3 counts =
      sizes_only(similarity.turn) *
      glm::dvec3(scene.probes.counts[0], scene.probes.counts[1], scene.probes.counts[2]);
  for (int axis = 0; axis < 3; ++axis) {
    scene.probes.counts[static_cast<std::size_t>(axis)] = static_cast<int>(counts[axis]);
  }
  if (scene.probes.box) scene.probes.box = box_of(*scene.probes.box, similarity);
  scene.environment_map.turn_deg = static_cast<float>(
      std::fmod(double{scene.environment_map.turn_deg} + turn_about_up_deg(similarity.turn), 360));
  scene.world_from_session.position = place_of(scene.world_from_session.position, similarity);
  if (similarity.turn != glm::dmat3(1.0)) {
    scene.world_from_session.orientation =
        glm::normalize(glm::dquat(similarity.turn) * scene.world_from_session.orientation);
  }
  return scene;
}

}  // namespace herr
