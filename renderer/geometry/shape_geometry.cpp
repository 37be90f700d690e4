// This file is compiled once per instruction set (Google Highway's foreach_target).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/geometry/shape_geometry.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include "renderer/geometry/shape_crossings-inl.h"
#include "renderer/geometry/shape_geometry.h"
#include "renderer/simd/simd_dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

template <class D>
struct FirstHit {
  hn::Mask<D> hits, entering;
  hn::Vec<D> t;
};

// The first crossing in (tnear, tfar]: the entry, or for a ray from within the exit. A ray without a
// direction crosses nothing; its exit from the box is at infinity.
template <class D, class Crossing>
HWY_INLINE FirstHit<D> first_hit(const CallbackRays<D>& rays, const Crossing& crossing) {
  const auto in_reach = [&](hn::Vec<D> t) HWY_ATTR {
    return hn::And(hn::Gt(t, rays.tnear()), hn::And(hn::Le(t, rays.tfar()), hn::Lt(t, hn::Inf(D()))));
  };
  const auto entering = in_reach(crossing.enter);
  const auto hits =
      hn::And(hn::And(rays.valid(), crossing.meets), hn::Or(entering, in_reach(crossing.leave)));
  return {hits, entering, hn::IfThenElse(entering, crossing.enter, crossing.leave)};
}

template <class D>
HWY_INLINE Point<D> origins(const CallbackRays<D>& rays) {
  return {rays.origin(0), rays.origin(1), rays.origin(2)};
}
template <class D>
HWY_INLINE Point<D> directions(const CallbackRays<D>& rays) {
  return {rays.direction(0), rays.direction(1), rays.direction(2)};
}

template <template <class> class Crossing>
HWY_INLINE void intersect_shape(const RTCIntersectFunctionNArguments* args) {
  for_each_group(args->N, [&](auto d, unsigned first) HWY_ATTR {
    using D = decltype(d);
    const CallbackRays<D> rays(args->rayhit, args->valid, args->N, first);
    const Crossing<D> crossing(origins(rays), directions(rays));
    const FirstHit<D> found = first_hit(rays, crossing);
    if (!hn::AllFalse(d, found.hits)) {
      const Point<D> normal = crossing.normal(found.entering);
      rays.set_tfar(found.hits, found.t);
      rays.set_hit(found.hits, normal.x, normal.y, normal.z, args->primID, args->geomID,
                   args->context->instID[0]);
    }
    report_hits(d, args->valid + first, found.hits);
  });
}

template <template <class> class Crossing>
HWY_INLINE void occlude_shape(const RTCOccludedFunctionNArguments* args) {
  for_each_group(args->N, [&](auto d, unsigned first) HWY_ATTR {
    using D = decltype(d);
    const CallbackRays<D> rays(args->ray, args->valid, args->N, first);
    const FirstHit<D> found = first_hit(rays, Crossing<D>(origins(rays), directions(rays)));
    rays.set_tfar(found.hits, hn::Neg(hn::Inf(d)));
    report_hits(d, args->valid + first, found.hits);
  });
}

void IntersectSphere(const RTCIntersectFunctionNArguments* args) {
  intersect_shape<SphereCrossing>(args);
}
void IntersectBox(const RTCIntersectFunctionNArguments* args) {
  intersect_shape<BoxCrossing>(args);
}
void OccludeSphere(const RTCOccludedFunctionNArguments* args) {
  occlude_shape<SphereCrossing>(args);
}
void OccludeBox(const RTCOccludedFunctionNArguments* args) {
  occlude_shape<BoxCrossing>(args);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace herr {

HWY_EXPORT(IntersectSphere);
HWY_EXPORT(IntersectBox);
HWY_EXPORT(OccludeSphere);
HWY_EXPORT(OccludeBox);

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
      geometry, sphere ? kernel_for(isa, [] { return &HWY_DYNAMIC_DISPATCH(IntersectSphere); })
                       : kernel_for(isa, [] { return &HWY_DYNAMIC_DISPATCH(IntersectBox); }));
  rtcSetGeometryOccludedFunction(geometry,
                                 sphere ? kernel_for(isa, [] { return &HWY_DYNAMIC_DISPATCH(OccludeSphere); })
                                        : kernel_for(isa, [] { return &HWY_DYNAMIC_DISPATCH(OccludeBox); }));
  rtcCommitGeometry(geometry);
  EmbreeSceneHandle scene(device);
  rtcAttachGeometryByID(scene.get(), geometry, 0);
  rtcReleaseGeometry(geometry);
  scene.commit();
  return scene;
}

}  // namespace herr
#endif
