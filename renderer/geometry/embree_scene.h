// The scene in Embree: one bottom-level scene per mesh, one level of instances, relative to a moving anchor.
// Before: scenes/ loads a Scene. After: tile kernels trace packets against top() and read records().
// Every transform is checked here: Debian's Embree aborts the process on a scale of zero.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/geometry/embree_device.h"
#include "renderer/geometry/instance_records.h"
#include "renderer/geometry/mesh_geometry.h"
#include "renderer/geometry/shading_scene.h"
#include "renderer/geometry/shape_geometry.h"
#include "renderer/geometry/surface_details.h"
#include "renderer/geometry/texture_levels.h"
#include "renderer/geometry/voxel_geometry.h"
#include "renderer/render_settings.h"
#include "scenes/scene.h"

namespace herr {

class EmbreeScene {
 public:
  // Builds everything, on `threads` threads of the calling arena. `isa` is resolved. Throws
  // std::runtime_error with Embree's message, std::bad_alloc when memory ran out, std::invalid_argument for a
  // transform it cannot take.
  EmbreeScene(const Scene& scene, Isa isa, int threads);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  // Moves the anchor when the head is more than 24 m from it. Takes effect with commit_changes().
  void follow(const glm::dvec3& head_position);
  // Lets an instance of kind mesh show another mesh with the same material; likewise.
  void show_mesh(std::size_t instance, std::uint32_t mesh);
  // Makes what changed visible to rays; returns the number of Embree commits (0 or 1).
  int commit_changes();
  // Puts the anchor where an earlier run had it, and commits.
  void place_at(const glm::dvec3& anchor);
  // A multiple of 16 m per axis; float coordinates are relative to it.
  const glm::dvec3& anchor() const { return anchor_; }
  bool placed() const { return placed_; }  // false until the first follow() or place_at()

  RTCScene top() const { return top_.get(); }
  const std::vector<InstanceRecord>& instances() const { return instances_; }

 private:
  void build_shapes(Isa isa);
  void build_meshes();
  void build_textures();
  void build_instances();
  void describe(std::size_t instance, const BakedMesh* baked);
  void place_instances();
  RTCScene bottom_of(const Instance& instance) const;

  const Scene& scene_;
  EmbreeDevice device_;
  std::vector<MeshGeometry> meshes_;
  std::vector<VoxelGeometry> voxels_;
  std::optional<EmbreeSceneHandle> sphere_, box_;  // where an instance shows one
  EmbreeSceneHandle top_;
  std::vector<RTCGeometry> instance_geometries_;
  std::vector<TextureLevels> texture_levels_;
  std::vector<TextureRecord> textures_;
  std::vector<InstanceRecord> instances_;
  std::vector<std::unique_ptr<DetailRecord>> details_;  // per instance, null where it has none
  InstanceTable table_;                                 // what hit filters look into
  glm::dvec3 anchor_{0.0};
  bool placed_ = false;
  bool changed_ = false;  // since the last commit
};

}  // namespace herr
