// A scene as it stands, scaled, turned by quarter turns and moved as a whole: who looks at it from where they
// then are sees the same picture. Light keeps its radiance: intensities grow with the square of the scale,
// irradiance of suns and what surfaces emit stay. What would move the scene later (placements, paths,
// timeline, animation) is left as it is.
// Before: a loaded scene. After: relations of pictures that must not differ.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "scenes/model/scene.h"

namespace herr {

// p -> scale * turn * p + move.
struct Similarity {
  double scale = 1;      // > 0
  glm::dmat3 turn{1.0};  // quarter_turn(), or products of them
  glm::dvec3 move{0.0};  // metres
};

// About the axis 0, 1 or 2, counter-clockwise as seen from its tip. Exact: entries are 0, 1 and -1.
glm::dmat3 quarter_turn(int axis);

// Why the scene has no such likeness: one sentence; empty when it has one.
std::string why_not_similar(const Scene& scene, const Similarity& similarity);

// Throw std::invalid_argument for a turn that is none of quarters. The light's path is left out.
Scene similar_scene(Scene scene, const Similarity& similarity);
AreaLight similar_light(AreaLight light, const Similarity& similarity);

}  // namespace herr
