#include "renderer/geometry/embree_scene.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>

#include "renderer/memory_use.h"
#include "scenes/model/transform_checks.h"

namespace herr {
namespace {

constexpr double kLargestAnchorStep_m = 16.0, kAnchorStepPerExtent = 16.0;
constexpr double kShortestAxisShare = 1e-17;
constexpr double kLargestCoordinate_m = 1e15;  // Embree asserts below 1.8e18; leaves room for rays' ends

}  // namespace

double anchor_step_m(double extent_m) {
  if (!(extent_m > 0) || kAnchorStepPerExtent * extent_m >= kLargestAnchorStep_m) return kLargestAnchorStep_m;
  return kAnchorStepPerExtent * std::exp2(std::floor(std::log2(extent_m)));
}

void check_transform(const glm::dmat4x3& m, const std::string& name) {
  const double reach = glm::length(m[0]) + glm::length(m[1]) + glm::length(m[2]) + glm::length(m[3]);
  const double box = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]),
               volume = std::abs(determinant(m));
  // scenes/ refuses such transforms with the name of the file; this is the last guard before Embree.
  if (!(reach < kLargestCoordinate_m) || !(volume >= 0.5 * kMinDeterminant) ||
      !(volume >= 0.5 * kMinVolumeShare * box)) {
    throw std::invalid_argument("instance '" + name +
                                "' has a transform that is not finite or not invertible");
  }
}

glm::dmat4x3 keep_rays_traceable(glm::dmat4x3 m, double rays_reach_m) {
  const double box = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
  const double least = kShortestAxisShare * rays_reach_m * box / std::abs(determinant(m));
  for (int axis = 0; axis < 3; ++axis) {
    const double length = glm::length(m[axis]);
    if (length < least) m[axis] *= least / length;
  }
  return m;
}

EmbreeScene::EmbreeScene(const Scene& scene, Isa isa, int threads)
    : scene_(scene), device_(isa, threads), top_(device_), seen_(scene.revision) {
  changes_.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) check_transform(instance.world_from_object, instance.name);
  build_meshes();
  build_deformations();
  build_shapes(isa);
  for (const VoxelGrid& grid : scene.voxel_grids) voxels_.push_back(build_voxels(device_, isa, grid));
  build_textures();
  build_instances();
}

EmbreeScene::~EmbreeScene() {
  for (RTCGeometry geometry : instance_geometries_) rtcReleaseGeometry(geometry);
}

void EmbreeScene::build_shapes(Isa isa) {
  for (const Instance& instance : scene_.instances) {
    if (instance.kind == ShapeKind::sphere && !sphere_) sphere_ = build_shape(device_, isa, instance.kind);
    if (instance.kind == ShapeKind::box && !box_) box_ = build_shape(device_, isa, instance.kind);
  }
}

void EmbreeScene::build_meshes() {
  std::vector<MeshFilter> filters(scene_.meshes.size());
  for (const Instance& instance : scene_.instances) {
    if (instance.kind != ShapeKind::mesh) continue;
    MeshFilter& filter = filters[instance.mesh];
    if (has_holes(scene_, instance) || shows_backs(scene_, instance)) filter.instances = &table_;
    filter.blends |= blends(scene_, instance);
    // Its coarser forms stand in its place.
    for (const CoarserMesh& form : scene_.meshes[instance.mesh].coarser) {
      MeshFilter& coarser = filters[form.mesh];
      if (filter.instances) coarser.instances = filter.instances;
      coarser.blends |= filter.blends;
    }
  }
  for (std::size_t i = 0; i < filters.size(); ++i) {
    meshes_.push_back(build_mesh(device_, scene_.meshes[i], filters[i]));
  }
}

void EmbreeScene::build_textures() {
  for (const TextureImage& texture : scene_.textures) {
    texture_levels_.push_back(build_levels(texture));
    textures_.push_back(texture_levels_.back().record);
  }
}

// The bottom-level scene that an instance places.
RTCScene EmbreeScene::bottom_of(const Instance& instance) const {
  if (instance.kind == ShapeKind::voxels) return voxels_[instance.grid].scene.get();
  if (instance.kind == ShapeKind::sphere) return sphere_->get();
  if (instance.kind == ShapeKind::box) return box_->get();
  return meshes_[instance.mesh].scene.get();
}

void EmbreeScene::build_instances() {
  rtcSetSceneBuildQuality(top_.get(), RTC_BUILD_QUALITY_HIGH);
  for (std::size_t i = 0; i < scene_.instances.size(); ++i) show_instance(i);
}

// What shading reads of an instance that shows `baked` (null: no mesh).
void EmbreeScene::describe(std::size_t i, const BakedMesh* baked) {
  const Instance& instance = scene_.instances[i];
  instances_[i] = instance_record(scene_, instance, baked, textures_);
  const auto detail = detail_record(scene_, instance, baked, textures_);
  if (!detail) return;
  if (!details_[i]) details_[i] = std::make_unique<DetailRecord>();
  *details_[i] = *detail;
  instances_[i].detail = details_[i].get();
}

void EmbreeScene::place_instances() {
  for (std::size_t i = 0; i < instance_geometries_.size(); ++i) {
    if (shown_[i] != 0) place_instance(i);
  }
  placed_ = changed_ = true;
}

void EmbreeScene::follow(const glm::dvec3& head_position) {
  if (placed_ && glm::distance(head_position, anchor_) <= kAnchorReach * anchor_step_m_) return;
  anchor_ = glm::round(head_position / anchor_step_m_) * anchor_step_m_;
  place_instances();
}

bool EmbreeScene::expect_rays(double reach_m) {
  const bool farther = reach_m > rays_reach_m_;
  if (farther) rays_reach_m_ = 2 * reach_m;
  return farther && placed_;
}

void EmbreeScene::show_mesh(std::size_t instance, std::uint32_t mesh) {
  rtcSetGeometryInstancedScene(instance_geometries_[instance], meshes_[mesh].scene.get());
  rtcCommitGeometry(instance_geometries_[instance]);
  describe(instance, &meshes_[mesh].baked);
  changed_ = true;
}

void EmbreeScene::commit_changes(SceneUpdate& done) {
  commit_bent(done);
  if (!changed_) return;
  top_.commit();
  changed_ = false;
  ++done.commits;
}

void EmbreeScene::place_at(const glm::dvec3& anchor) {
  anchor_ = anchor;
  place_instances();
  SceneUpdate nobodys;
  commit_changes(nobodys);
}

GeometryMemory EmbreeScene::memory() const {
  GeometryMemory memory;
  memory.acceleration = device_.bytes();
  for (const MeshGeometry& mesh : meshes_) memory.surfaces += mesh.baked.bytes();
  for (const auto& deformed : deformed_) memory.surfaces += deformed->bytes();
  memory.surfaces += bytes_of(instances_) + bytes_of(details_) + bytes_of(instance_geometries_);
  for (const auto& detail : details_) memory.surfaces += detail ? std::int64_t{sizeof(DetailRecord)} : 0;
  for (const TextureLevels& levels : texture_levels_) memory.textures += bytes_of(levels.texels);
  memory.textures += bytes_of(texture_levels_) + bytes_of(textures_);
  for (const VoxelGeometry& voxels : voxels_) memory.voxels += voxels.octree->bytes();
  return memory;
}

}  // namespace herr
