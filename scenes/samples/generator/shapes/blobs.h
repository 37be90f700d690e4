// Implicit solids: signed distances that melt into each other. The statue and the hare are made of them.
// After: surface_nets turns a distance into triangles. Formulas: Quilez, "Distance functions" (2008-).
#pragma once

#include <glm/vec3.hpp>

namespace herr::samples {

// Distances are negative inside, and exact or smaller than exact (lower bounds) outside.

// A capsule from a to b whose radius runs from radius_a to radius_b.
float tapered_capsule(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, float radius_a,
                      float radius_b);

// An ellipsoid with semi-axes along x, y, z.
float ellipsoid(const glm::vec3& p, const glm::vec3& centre, const glm::vec3& semi_axes);

// The union of two solids with a fillet of about `fillet` metres where they meet.
float smooth_union(float a, float b, float fillet);

// a without b, with a fillet.
float smooth_difference(float a, float b, float fillet);

}  // namespace herr::samples
