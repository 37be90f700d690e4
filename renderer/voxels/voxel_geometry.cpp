#include "renderer/voxels/voxel_geometry.h"

#include "renderer/simd/kernel_for.h"
#include "renderer/voxels/voxel_view.h"

namespace herr {

HERR_DECLARE_KERNEL(RTCIntersectFunctionN, intersect_voxels);
HERR_DECLARE_KERNEL(RTCOccludedFunctionN, occlude_voxels);

namespace {

void grid_bounds(const RTCBoundsFunctionArguments* args) {
  const auto& grid = *static_cast<const VoxelView*>(args->geometryUserPtr);
  RTCBounds& box = *args->bounds_o;
  box.lower_x = box.lower_y = box.lower_z = 0;
  box.upper_x = static_cast<float>(grid.counts[0]);
  box.upper_y = static_cast<float>(grid.counts[1]);
  box.upper_z = static_cast<float>(grid.counts[2]);
}

}  // namespace

VoxelGeometry build_voxels(const EmbreeDevice& device, Isa isa, const VoxelGrid& grid) {
  auto octree = std::make_unique<const VoxelOctree>(grid);
  auto view = std::make_unique<const VoxelView>(view_of(*octree));
  VoxelGeometry built{std::move(octree), std::move(view), EmbreeSceneHandle(device)};
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryMask(geometry, kAllMask);
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryUserData(geometry, const_cast<VoxelView*>(built.view.get()));
  rtcSetGeometryBoundsFunction(geometry, grid_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, HERR_KERNEL_FOR(isa, intersect_voxels));
  rtcSetGeometryOccludedFunction(geometry, HERR_KERNEL_FOR(isa, occlude_voxels));
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(built.scene.get(), geometry, 0);
  rtcReleaseGeometry(geometry);
  built.scene.commit();
  return built;
}

}  // namespace herr
