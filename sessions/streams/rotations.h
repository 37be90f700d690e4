// Turning at constant angular velocity, written so that it is exact for any step: no renormalised lerps.
// Used by the samplers of poses and of gaze.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace herr {

// The orientation that turns from `a` (share 0) the short way to `b` (share 1) at constant angular velocity;
// shares above 1 go on turning. a and b are unit quaternions.
glm::dquat turn_from_to(const glm::dquat& a, const glm::dquat& b, double share);

// The same for unit directions, along the great circle. Opposite directions turn about an arbitrary axis.
glm::dvec3 turn_from_to(const glm::dvec3& a, const glm::dvec3& b, double share);

}  // namespace herr
