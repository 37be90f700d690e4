// The `shapes` of a scene document: spheres, ellipsoids and boxes that are met analytically.
// Before: scene_document walks the document. After: Scene::instances of kind sphere or box.
#pragma once

#include "scenes/model/scene.h"
#include "sessions/files/strict_json.h"

namespace herr {

// Appends the material and instance of one entry. Throws InputError that names the field.
void append_shape(const JsonObject& entry, Scene& scene);

}  // namespace herr
