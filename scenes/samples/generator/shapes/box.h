// Boxes with flat sides: the room, its furniture, plinths.
#pragma once

#include "scenes/samples/generator/shapes/mesh.h"

namespace herr::samples {

// An axis-aligned box; uv in metres divided by `metres_per_picture`, along the two axes of each side.
Mesh box(const glm::vec3& lower, const glm::vec3& upper, float metres_per_picture = 1.0f);

// A quad with corners in counter-clockwise order seen from outside; uv (0, 1), (1, 1), (1, 0), (0, 0),
// that is: the first two corners are the lower edge of the picture. `repeat` scales the uv.
Mesh quad(const std::array<glm::vec3, 4>& corners, const glm::vec2& repeat = glm::vec2(1.0f));

}  // namespace herr::samples
