#include "renderer/geometry/shape_geometry.h"

#include "renderer/simd/kernel_for.h"

namespace herr {

HERR_DECLARE_KERNEL(RTCIntersectFunctionN, intersect_sphere);
HERR_DECLARE_KERNEL(RTCIntersectFunctionN, intersect_box);
HERR_DECLARE_KERNEL(RTCOccludedFunctionN, occlude_sphere);
HERR_DECLARE_KERNEL(RTCOccludedFunctionN, occlude_box);

namespace {

// Embree meets boxes with one rounding per plane, relative to the ray's origin: this much around a shape
// keeps that from deciding, up to some thousand radii away. The kernels decide.
constexpr float kMargin = 0x1p-10f;

void shape_bounds(const RTCBoundsFunctionArguments* args) {
  RTCBounds& box = *args->bounds_o;
  box.lower_x = box.lower_y = box.lower_z = -1 - kMargin;
  box.upper_x = box.upper_y = box.upper_z = 1 + kMargin;
}

}  // namespace

EmbreeSceneHandle build_shape(const EmbreeDevice& device, Isa isa, ShapeKind kind) {
  const bool sphere = kind == ShapeKind::sphere;
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryMask(geometry, kAllMask);
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryBoundsFunction(geometry, shape_bounds, nullptr);
  rtcSetGeometryIntersectFunction(
      geometry, sphere ? HERR_KERNEL_FOR(isa, intersect_sphere) : HERR_KERNEL_FOR(isa, intersect_box));
  rtcSetGeometryOccludedFunction(
      geometry, sphere ? HERR_KERNEL_FOR(isa, occlude_sphere) : HERR_KERNEL_FOR(isa, occlude_box));
  rtcCommitGeometry(geometry);
  EmbreeSceneHandle scene(device);
  rtcAttachGeometryByID(scene.get(), geometry, 0);
  rtcReleaseGeometry(geometry);
  scene.commit();
  return scene;
}

}  // namespace herr
