// Objects of a scene: what its document places under one name. Before: load_scene. After: Scene::objects.
#pragma once

#include "scenes/scene.h"

namespace herr {

// Makes an object of each instance that belongs to none, with the instance's name, placed by its translation
// alone.
void complete_objects(Scene& scene);

}  // namespace herr
