// Objects of a scene: what its document places under one name. Before: load_scene. After: Scene::objects.
#pragma once

#include "scenes/model/scene.h"

namespace herr {

// Makes an object of one instance that belongs to none: it has the instance's name and is placed by its
// translation alone. The object is valid until the next one is made.
PlacedObject& add_object_of(std::uint32_t instance, Scene& scene);
// Of each that belongs to none.
void complete_objects(Scene& scene);

}  // namespace herr
