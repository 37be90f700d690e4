// The analytic shapes in Embree: the unit sphere and the box [-1, 1]^3 as user geometry, each a bottom-level
// scene that all its instances share. Before: Instance::kind. After: embree_scene instances it, surfaces
// reads the hit's normal (outward, in object space).
#pragma once

#include "renderer/embree/embree_device.h"
#include "scenes/model/scene.h"

namespace herr {

// `kind`: sphere or box. `isa` is resolved. A hit counts for tnear < t <= tfar, from outside and from within.
// Throws as check_embree.
EmbreeSceneHandle build_shape(const EmbreeDevice& device, Isa isa, ShapeKind kind);

}  // namespace herr
