// Is a transform one that the ray tracer can take? Embree aborts the process on a scale of 0 and on values
// that are not finite, so every matrix passes here first. How small it makes things is no fault: object space
// may count in micrometres or in integers of 16 bits. Before: load_gltf, scene_document. After:
// Scene::instances.
#pragma once

#include <glm/mat4x3.hpp>
#include <optional>
#include <string>

namespace herr {

inline constexpr double kFarthest_m = 1e12;  // of any coordinate; its square still fits a float
// Of a scale along one axis: less counts as 0.
inline constexpr double kMinAxisScale = 1e-24;
// Uniform scale 1e-12. A float holds the inverse of what is larger, and the volume itself.
inline constexpr double kMinDeterminant = 1e-36;
// Of the volume that the three axes would span at right angles: a flatter shear has no
// usable inverse in float.
inline constexpr double kMinVolumeShare = 1e-6;

// Volume factor; negative for mirrored transforms.
double determinant(const glm::dmat4x3& transform);

// What is wrong with it ("has a scale of 0 on the y axis"), or none.
std::optional<std::string> transform_problem(const glm::dmat4x3& transform);

// a_from_b * b_from_c.
glm::dmat4x3 compose(const glm::dmat4x3& a_from_b, const glm::dmat4x3& b_from_c);
// The same, where b counts in units of c.
glm::dmat4x3 in_units(const glm::dmat4x3& a_from_b, double unit);

}  // namespace herr
