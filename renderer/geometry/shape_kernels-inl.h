// Embree's callbacks for spheres and boxes: where rays meet them. Compiled once for each instruction set
// (simd/kernel_instance.cpp.in).
#pragma once

#include "renderer/geometry/shape_crossings-inl.h"
#include "renderer/geometry/shape_geometry.h"

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

void intersect_sphere(const RTCIntersectFunctionNArguments* args) {
  intersect_shape<SphereCrossing>(args);
}
void intersect_box(const RTCIntersectFunctionNArguments* args) {
  intersect_shape<BoxCrossing>(args);
}
void occlude_sphere(const RTCOccludedFunctionNArguments* args) {
  occlude_shape<SphereCrossing>(args);
}
void occlude_box(const RTCOccludedFunctionNArguments* args) {
  occlude_shape<BoxCrossing>(args);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
