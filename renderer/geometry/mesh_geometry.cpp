#include "renderer/geometry/mesh_geometry.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace herr {

MeshGeometry build_mesh(const EmbreeDevice& device, const TriangleMesh& mesh, const MeshFilter& filter) {
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryMask(geometry, kAllMask);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(glm::vec3), mesh.positions.size());
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          sizeof(mesh.triangles[0]), mesh.triangles.size());
  check_embree(device.get());
  std::ranges::copy(mesh.positions, static_cast<glm::vec3*>(vertices));
  std::ranges::copy(mesh.triangles, static_cast<std::array<std::uint32_t, 3>*>(indices));
  if (filter.instances != nullptr) filter_hits(geometry, *filter.instances);
  rtcCommitGeometry(geometry);
  MeshGeometry built{EmbreeSceneHandle(device), {}};
  rtcSetSceneBuildQuality(built.scene.get(),
                          filter.blends ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_HIGH);
  rtcAttachGeometryByID(built.scene.get(), geometry, 0);
  rtcReleaseGeometry(geometry);
  built.scene.commit();
  built.baked = bake_triangles(mesh);
  return built;
}

}  // namespace herr
