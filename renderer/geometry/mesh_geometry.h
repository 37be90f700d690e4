// One triangle mesh in Embree: a bottom-level scene of its own, and the records that shading gathers.
// Before: Scene::meshes. After: embree_scene instances it.
#pragma once

#include "renderer/geometry/embree_device.h"
#include "renderer/geometry/triangle_records.h"
#include "scenes/scene.h"

namespace herr {

struct MeshGeometry {
  EmbreeSceneHandle scene;  // committed
  BakedMesh baked;
};

// Throws as check_embree.
MeshGeometry build_mesh(const EmbreeDevice& device, const TriangleMesh& mesh);

}  // namespace herr
