// One triangle mesh in Embree: a bottom-level scene of its own, and the records that shading gathers.
// Before: Scene::meshes. After: embree_scene instances it.
#pragma once

#include "renderer/embree/embree_device.h"
#include "renderer/geometry/alpha_filter.h"
#include "renderer/geometry/triangle_records.h"
#include "scenes/model/scene.h"

namespace herr {

struct MeshGeometry {
  EmbreeSceneHandle scene;  // committed
  BakedMesh baked;
};

// What hits of a mesh must be asked before they count.
struct MeshFilter {
  const InstanceTable* instances = nullptr;  // null: nothing, every hit counts
  // Some instance blends. Shadow rays then multiply what passes its hits, so no triangle may be met twice, as
  // Embree's best trees would.
  bool blends = false;
};

// Throws as check_embree.
MeshGeometry build_mesh(const EmbreeDevice& device, const TriangleMesh& mesh, const MeshFilter& filter);

}  // namespace herr
