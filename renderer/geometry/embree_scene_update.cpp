// Stage: acceleration structures. What SceneState says has changed goes to Embree, slot by slot; an instance
// that only moved costs its own transform and one commit of the top level.
#include <algorithm>
#include <glm/geometric.hpp>

#include "renderer/broken_on_purpose.h"
#include "renderer/geometry/embree_scene.h"

namespace herr {

// Makes slot `slot` show what the scene has there now. Its geometry is made once and used again.
void EmbreeScene::show_instance(std::size_t slot) {
  const Instance& instance = scene_.instances[slot];
  if (slot >= instance_geometries_.size()) {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcAttachGeometryByID(top_.get(), geometry, static_cast<unsigned>(slot));
    instance_geometries_.push_back(geometry);
    instances_.emplace_back();
    details_.emplace_back();
    shown_.push_back(1);
    table_.records = instances_.data();
  }
  RTCGeometry geometry = instance_geometries_[slot];
  if (instance.present) {
    rtcSetGeometryInstancedScene(geometry, bottom_of(instance));
    rtcSetGeometryMask(geometry, instance.catcher ? kCatcherMask : kObjectMask);
    describe(slot, instance.kind == ShapeKind::mesh ? &meshes_[instance.mesh].baked : nullptr);
    if (shown_[slot] == 0) rtcEnableGeometry(geometry);
  } else if (shown_[slot] != 0) {
    rtcDisableGeometry(geometry);
  }
  shown_[slot] = instance.present ? 1 : 0;
}

void EmbreeScene::place_instance(std::size_t slot) {
  glm::dmat4x3 m =
      keep_rays_traceable(scene_.instances[slot].world_from_object,
                          rays_reach_m_ + glm::length(anchor_) + 2 * kAnchorReach * anchor_step_m_);
  if constexpr (kFault == Fault::dropped_anchor) m[3] = glm::dvec3(glm::vec3(m[3]));
  m[3] -= anchor_;
  float columns[12];
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) columns[3 * column + row] = static_cast<float>(m[column][row]);
  }
  rtcSetGeometryTransform(instance_geometries_[slot], 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  rtcCommitGeometry(instance_geometries_[slot]);
}

void EmbreeScene::build_deformations() {
  for (const MeshDeformation& deformation : scene_.deformations) {
    deformed_.push_back(std::make_unique<DeformedMesh>(scene_.meshes[deformation.mesh], deformation,
                                                       meshes_[deformation.mesh]));
  }
  bent_.resize(deformed_.size());
  deforms_.resize(meshes_.size());
  for (const MeshDeformation& deformation : scene_.deformations) deforms_[deformation.mesh] = 1;
}

void EmbreeScene::bend(const SceneState& state, RenderThreads& threads) {
  for (std::size_t i = 0; i < std::min(deformed_.size(), state.poses.size()); ++i) {
    if (deformed_[i]->bend(state.poses[i], threads)) bent_[i] = 1;
  }
}

void EmbreeScene::commit_bent(SceneUpdate& done) {
  bool any = false;
  for (std::size_t i = 0; i < deformed_.size(); ++i) {
    if (bent_[i] == 0) continue;
    bent_[i] = 0;
    any = true;
    ++(deformed_[i]->commit() ? done.rebuilt : done.refitted);
    ++done.commits;
    check_embree(device_.get());
  }
  // The bounds that instances have of a bent mesh are those of their own commit.
  for (std::size_t slot = 0; any && slot < instance_geometries_.size(); ++slot) {
    const Instance& instance = scene_.instances[slot];
    const bool shows_bent =
        instance.kind == ShapeKind::mesh && shown_[slot] != 0 && deforms_[instance.mesh] != 0;
    if (shows_bent) rtcCommitGeometry(instance_geometries_[slot]);
  }
  changed_ = changed_ || any;
}

Bounds EmbreeScene::shape(std::size_t deformation) const {
  RTCBounds b;
  rtcGetSceneBounds(meshes_[scene_.deformations[deformation].mesh].scene.get(), &b);
  return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

void EmbreeScene::apply(const SceneState& state, SceneUpdate& done) {
  state.changes.since(seen_, changes_);
  done.relit = state.changes.relit_since(seen_);
  seen_ = std::max(seen_, state.changes.latest());
  done.slots = changes_;
  for (const ChangedSlot& change : done.slots) {
    const std::size_t slot = change.slot;
    // Slots beyond those that this was built with came later, and count as new.
    const bool is_new = slot >= instance_geometries_.size();
    const bool restyled = is_new || change.renewed;
    const bool was_there = !is_new && shown_[slot] != 0;
    const bool is_there = scene_.instances[slot].present;
    if (is_there) check_transform(scene_.instances[slot].world_from_object, scene_.instances[slot].name);
    if (restyled) {
      show_instance(slot);
    } else if (is_there) {
      set_matrix(scene_.instances[slot], instances_[slot]);
    }
    if (is_there) place_instance(slot);
    changed_ = changed_ || is_there || was_there;
    if (is_there && was_there) ++(restyled ? done.restyled : done.moved);
    if (is_there && !was_there) ++done.spawned;
    if (!is_there && was_there) ++done.removed;
  }
}

}  // namespace herr
