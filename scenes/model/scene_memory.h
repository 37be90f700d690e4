// What a loaded scene holds in memory, by what it is for: what its arrays have room for. Names and paths of
// files are not counted, nor what a renderer makes of it.
// Before: a loaded scene. After: memory_bytes of every report.
#pragma once

#include <cstdint>

#include "scenes/model/scene.h"

namespace herr {

struct SceneMemory {
  std::int64_t meshes = 0;       // and how they bend
  std::int64_t textures = 0;     // pixels as decoded
  std::int64_t voxels = 0;       // bricks of grids
  std::int64_t environment = 0;  // its picture
  std::int64_t objects = 0;      // instances, materials, lights, paths, animation, changes
};

SceneMemory memory_of(const Scene& scene);

}  // namespace herr
