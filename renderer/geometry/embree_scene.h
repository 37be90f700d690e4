// The scene in Embree: one bottom-level scene per mesh, one level of instances, relative to a moving anchor.
// Before: scenes/ loads a Scene. After: tile kernels trace packets against top() and read records().
// Every transform is checked here: Debian's Embree aborts the process on a scale of zero.
#pragma once

#include <cstdint>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/embree/embree_device.h"
#include "renderer/geometry/deformed_mesh.h"
#include "renderer/geometry/instance_records.h"
#include "renderer/geometry/mesh_geometry.h"
#include "renderer/geometry/shading_scene.h"
#include "renderer/geometry/shape_geometry.h"
#include "renderer/geometry/surface_details.h"
#include "renderer/geometry/texture_levels.h"
#include "renderer/render_settings.h"
#include "renderer/voxels/voxel_geometry.h"
#include "scenes/model/scene.h"

namespace herr {

// Throws std::invalid_argument unless the matrix is one that Embree can take: finite, and no axis collapsed.
void check_transform(const glm::dmat4x3& matrix, const std::string& name);

// How far apart the places are on which the anchor may stand, along each axis: 16 m, and in a scene smaller
// than a metre a power of two that is 8 to 16 times its extent. Floats then round to 2e-6 of the scene.
double anchor_step_m(double extent_m);
inline constexpr double kAnchorReach = 1.5;  // steps that a head may be away from the anchor

// The matrix with axes lengthened that are so short that rays, turned into object space, would leave the
// range that Embree takes: those below 1e-17 of how far rays start and lead, which no float of that size
// resolves.
glm::dmat4x3 keep_rays_traceable(glm::dmat4x3 matrix, double rays_reach_m);

// What a frame changed, and what that took.
struct SceneUpdate {
  int commits = 0;       // Embree scenes committed
  double commit_ms = 0;  // wall time of the commits
  int moved = 0;         // instances that stand elsewhere
  int spawned = 0, removed = 0;
  int restyled = 0;                    // instances with another material or mesh
  int refitted = 0, rebuilt = 0;       // meshes that bent: boxes moved along, or sorted anew
  bool relit = false;                  // lights shine otherwise
  std::span<const ChangedSlot> slots;  // which instances; valid until the next apply()
  bool anything() const { return commits > 0 || restyled > 0 || relit; }
  bool other_traits() const { return spawned > 0 || removed > 0 || restyled > 0; }
};

// Bytes, by what they are for.
struct GeometryMemory {
  std::int64_t acceleration = 0;  // Embree's own: trees, vertices, instances
  std::int64_t surfaces = 0;      // what shading reads of triangles and instances, and bends of meshes
  std::int64_t textures = 0, voxels = 0;
};

class EmbreeScene {
 public:
  // Builds everything, on `threads` threads of the calling arena. `isa` is resolved. Throws
  // std::runtime_error with Embree's message, std::bad_alloc when memory ran out, std::invalid_argument for a
  // transform it cannot take.
  EmbreeScene(const Scene& scene, Isa isa, int threads);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  // How large what is there is. The next anchor stands on a step that fits.
  void fit_anchor(double extent_m) { anchor_step_m_ = anchor_step_m(extent_m); }
  // Moves the anchor when the head is more than 1.5 of its steps from it. Takes effect with commit_changes(),
  // as do apply() and show_mesh().
  void follow(const glm::dvec3& head_position);
  // Takes up what the state says has changed since the last call (the first: since this was built), and looks
  // at nothing else of the scene. Allocates only for instances beyond the most that were ever there.
  void apply(const SceneState& state, SceneUpdate& done);
  // Outside the arena: bends the meshes whose pose is new, on all threads.
  void bend(const SceneState& state, RenderThreads& threads);
  // How far from the world's origin rays start or lead, at most. True if that is farther than instances were
  // placed for: place_at() anew.
  bool expect_rays(double reach_m);
  // Lets an instance of kind mesh show another mesh with the same material.
  void show_mesh(std::size_t instance, std::uint32_t mesh);
  // Makes what changed visible to rays: bent meshes, then the top level once; nothing where nothing changed.
  void commit_changes(SceneUpdate& done);
  // Puts the anchor where an earlier run had it, and commits.
  void place_at(const glm::dvec3& anchor);
  // The next follow() places everything anew.
  void leave_anchor() { placed_ = false; }
  // A multiple of anchor_step_m() per axis; float coordinates are relative to it.
  const glm::dvec3& anchor() const { return anchor_; }
  bool placed() const { return placed_; }  // false until the first follow() or place_at()

  RTCScene top() const { return top_.get(); }
  const std::vector<InstanceRecord>& instances() const { return instances_; }
  // Around a mesh that bends, as it was committed last, in object space. `deformation`: of
  // Scene::deformations.
  Bounds shape(std::size_t deformation) const;
  GeometryMemory memory() const;

 private:
  void build_shapes(Isa isa);
  void build_meshes();
  void build_textures();
  void build_instances();
  void describe(std::size_t instance, const BakedMesh* baked);
  void build_deformations();
  void commit_bent(SceneUpdate& done);
  void show_instance(std::size_t slot);
  void place_instance(std::size_t slot);
  void place_instances();
  RTCScene bottom_of(const Instance& instance) const;

  const Scene& scene_;
  EmbreeDevice device_;
  std::vector<MeshGeometry> meshes_;
  std::vector<VoxelGeometry> voxels_;
  std::vector<std::unique_ptr<DeformedMesh>> deformed_;  // per Scene::deformations
  std::vector<std::uint8_t> deforms_;                    // per mesh: some deformation bends it
  std::vector<std::uint8_t> bent_;                       // per deformation: since the last commit
  std::optional<EmbreeSceneHandle> sphere_, box_;        // where an instance shows one
  EmbreeSceneHandle top_;
  std::vector<RTCGeometry> instance_geometries_;
  std::vector<std::uint8_t> shown_;   // per instance: it is there
  SlotChanges::Number seen_ = 0;      // up to which change of the scene this has looked
  std::vector<ChangedSlot> changes_;  // since the look before
  std::vector<TextureLevels> texture_levels_;
  std::vector<TextureRecord> textures_;
  std::vector<InstanceRecord> instances_;
  std::vector<std::unique_ptr<DetailRecord>> details_;  // per instance, null where it has none
  InstanceTable table_;                                 // what hit filters look into
  glm::dvec3 anchor_{0.0};
  double anchor_step_m_ = anchor_step_m(1);
  double rays_reach_m_ = 0;
  bool placed_ = false;
  bool changed_ = false;  // since the last commit
};

}  // namespace herr
