// What can be counted about a scene: objects, triangles, materials, textures, lights, memory.
// Before: load_scene. After: the report of `herr inspect`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/model/scene.h"

namespace herr {

// Instances with the same name up to the first slash: one entry of the scene document.
struct SceneObject {
  std::string name;
  std::int64_t instances = 0, triangles = 0, voxels = 0;
  bool catcher = false;
  // Share of a recording's poses that have it in view (scene_in_view.h); none without one, and of catchers.
  std::optional<double> in_view;
  // Likewise of its middle, and the pose (session_from_head) that has the middle nearest to straight ahead,
  // with its seconds after the session's start (central_moments.h); none where no pose has the middle in
  // view.
  std::optional<double> middle_in_view, most_central_s;
  std::optional<Pose> most_central;
};

// A grid of voxels, however often it is placed.
struct GridFacts {
  std::string name;
  glm::ivec3 counts{0};
  std::int64_t voxels = 0, bytes = 0;  // bytes as loaded; its octree takes about as much again
};

struct SceneFacts {
  std::string name;
  std::vector<SceneObject> objects;  // most triangles first, then most voxels
  std::vector<GridFacts> grids;
  std::int64_t instances = 0, catchers = 0, meshes = 0;
  std::int64_t triangles = 0, catcher_triangles = 0;
  std::int64_t spheres = 0, boxes = 0;    // analytic shapes, catchers included
  std::int64_t stored_triangles = 0;      // each mesh once
  std::int64_t degenerate_triangles = 0;  // of the stored ones: without area, no ray can hit them
  std::int64_t materials = 0, mirrors = 0, emitters = 0;
  std::int64_t textures = 0, texture_pixels = 0;
  std::int64_t lights = 0, moving_lights = 0, virtual_lights = 0;
  std::int64_t moving_objects = 0;  // that follow a path
  glm::vec3 ambient{0.0f}, environment{0.0f};
  std::optional<Exposure> exposure;  // the document's
  Bounds bounds;
  std::int64_t geometry_bytes = 0, texture_bytes = 0,
               voxel_bytes = 0;  // as loaded, without acceleration structures
  std::vector<std::filesystem::path> files;
};

SceneFacts facts_of(const Scene& scene);

}  // namespace herr
