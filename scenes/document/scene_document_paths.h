// `path` of an entry of a scene document: where its object stands over time.
// Before: the readers of gltf, voxels, shapes and catchers. After: PlacedObject::path. Every function throws
// InputError that names the field.
#pragma once

#include "scenes/model/object_path.h"
#include "scenes/model/scene.h"
#include "sessions/files/strict_json.h"

namespace herr {

inline constexpr int kMostPathKeys = 100'000;  // 18 minutes at 90 Hz

// Empty where the entry has none. Parts that a key does not give are those of `own`, the entry's placement.
ObjectPath parse_path(const JsonObject& entry, const Placement& own);

// Refuses a path with a key at which `part` could not be traced. It stands in the entry's own space still.
// Between two keys it can be traced where it can at both: the volume is no smaller than at one of them.
void check_path(const JsonObject& entry, const ObjectPath& path, const Scene& scene, const Instance& part);

// Of an entry that is one instance, the scene's last: makes its object, which follows the entry's path.
void put_on_path(const JsonObject& entry, Scene& scene);

}  // namespace herr
