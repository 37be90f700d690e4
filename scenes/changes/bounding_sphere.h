// The sphere about all that a scene shows at a time. Before: World::state. After: a camera that is to see the
// whole of it.
#pragma once

#include "scenes/model/scene.h"

namespace herr {

struct BoundingSphere {
  glm::dvec3 centre{0.0};
  double radius = 0;  // 0: nothing is there, or a single point
};

// About the middle of the box around every instance that is there and no catcher (of all if there are only
// catchers), as far as the farthest vertex of a mesh, posed as `state` says, or corner of a grid or box; of a
// sphere with unequal axes as far as its longest one.
BoundingSphere bounding_sphere(const Scene& scene, const SceneState& state);

}  // namespace herr
