// The sphere about all that a scene shows at a time, or about what a picture of it is of. Before:
// World::state. After: a camera that is to see the whole of it.
#pragma once

#include <string>
#include <vector>

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

struct FramedSphere {
  BoundingSphere sphere;
  std::vector<std::string> left_out;  // names of objects, in the document's order
};

// The same, without floors and walls that would make what stands before them tiny: objects of a document
// (Scene::objects) whose box is flat, its shortest side at most a tenth of the next longer one, and at least
// three times as long as the box about all that are not flat. A model alone is one object: never left out.
FramedSphere framed_sphere(const Scene& scene, const SceneState& state);

}  // namespace herr
