// Where a line o + t d enters and leaves the unit sphere and the box [-1, 1]^3, any number of lanes.
// Sphere: Haines et al., "Precision Improvements for Ray/Sphere Intersection" (Ray Tracing Gems, 2019,
// chapter 7): the discriminant from the point of closest approach, the smaller root from the larger one.
// Box: slabs, Majercik et al., "A Ray-Box Intersection Algorithm and Efficient Dynamic Voxel Rendering"
// (2018), with planes that the line runs along told apart first, as 0 * infinity would be NaN (Williams et
// al. 2005). NaN never counts as a crossing.
#pragma once

#include "renderer/embree/callback_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

template <class D>
struct Point {
  hn::Vec<D> x, y, z;
};

template <class D>
HWY_INLINE hn::Vec<D> dot(const Point<D>& a, const Point<D>& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
template <class D>
HWY_INLINE Point<D> along(const Point<D>& o, hn::Vec<D> t, const Point<D>& d) {
  return {hn::MulAdd(t, d.x, o.x), hn::MulAdd(t, d.y, o.y), hn::MulAdd(t, d.z, o.z)};
}

// Of a line with the unit sphere.
template <class D>
class SphereCrossing {
 public:
  using V = hn::Vec<D>;

  HWY_INLINE SphereCrossing(const Point<D>& o, const Point<D>& d) : d_(d) {
    const V one = hn::Set(D(), 1.0f);
    const V length2 = dot<D>(d, d), inverse2 = hn::Div(one, length2);
    // The closest approach, in two steps: the second takes away what rounding of the first left along d.
    V closest = hn::Neg(hn::Mul(dot<D>(o, d), inverse2));
    closest_ = along<D>(o, closest, d);
    const V rest = hn::Neg(hn::Mul(dot<D>(closest_, d), inverse2));
    closest_ = along<D>(closest_, rest, d);
    closest = hn::Add(closest, rest);
    const V discriminant = hn::Sub(one, dot<D>(closest_, closest_));
    meets = hn::Ge(discriminant, hn::Zero(D()));
    half_ = hn::Sqrt(hn::Mul(hn::Max(discriminant, hn::Zero(D())), inverse2));
    // closest - half and closest + half: the one nearer to 0 would cancel, and is their
    // product over the other.
    const V larger = hn::Add(closest, hn::CopySign(half_, closest));
    const V product = hn::Mul(hn::Sub(dot<D>(o, o), one), inverse2);
    const V smaller = hn::Div(product, larger);
    const auto ahead = hn::Gt(larger, hn::Zero(D()));  // not closest: that may be -0
    enter = hn::IfThenElse(ahead, smaller, larger);
    leave = hn::IfThenElse(ahead, larger, smaller);
  }

  // Outward normal where the line enters (`entering`) or leaves, unit but for rounding.
  HWY_INLINE Point<D> normal(hn::Mask<D> entering) const {
    return along<D>(closest_, hn::IfThenElse(entering, hn::Neg(half_), half_), d_);
  }

  V enter, leave;
  hn::Mask<D> meets;

 private:
  Point<D> d_, closest_;
  V half_;
};

// Of a line with the box.
template <class D>
class BoxCrossing {
 public:
  using V = hn::Vec<D>;

  HWY_INLINE BoxCrossing(const Point<D>& o, const Point<D>& d)
      : d_(d), x_(slab(o.x, d.x)), y_(slab(o.y, d.y)), z_(slab(o.z, d.z)) {
    enter = hn::Max(x_.near, hn::Max(y_.near, z_.near));
    leave = hn::Min(x_.far, hn::Min(y_.far, z_.far));
    meets = hn::Le(enter, leave);
  }

  // Outward normal of the face through which the line enters (`entering`) or leaves; on an
  // edge x before y before z.
  HWY_INLINE Point<D> normal(hn::Mask<D> entering) const {
    const V zero = hn::Zero(D()), t = hn::IfThenElse(entering, enter, leave);
    const auto on = [&](const Slab& slab)
                        HWY_ATTR { return hn::Eq(t, hn::IfThenElse(entering, slab.near, slab.far)); };
    const auto on_x = on(x_), on_y = hn::AndNot(on_x, on(y_));
    const auto on_z = hn::Not(hn::Or(on_x, on_y));
    const auto face = [&](hn::Mask<D> lanes, V direction) HWY_ATTR {
      const V outwards = hn::IfThenElse(entering, hn::Neg(direction), direction);
      return hn::IfThenElse(lanes, hn::CopySign(hn::Set(D(), 1.0f), outwards), zero);
    };
    return {face(on_x, d_.x), face(on_y, d_.y), face(on_z, d_.z)};
  }

  V enter, leave;
  hn::Mask<D> meets;

 private:
  struct Slab {
    V near, far;
  };

  // Between the planes -1 and 1 of an axis: one subtraction and one division, each rounded once.
  HWY_INLINE static Slab slab(V o, V d) {
    const V one = hn::Set(D(), 1.0f), endless = hn::Inf(D());
    const V below = hn::Div(hn::Sub(hn::Neg(one), o), d), above = hn::Div(hn::Sub(one, o), d);
    // Also directions that the processor would take for 0.
    const auto parallel = hn::Lt(hn::Abs(d), hn::Set(D(), 1.17549435e-38f));
    const V inside = hn::CopySign(endless, hn::Sub(one, hn::Abs(o)));  // +: the line runs between the planes
    return {hn::IfThenElse(parallel, hn::Neg(inside), hn::Min(below, above)),
            hn::IfThenElse(parallel, inside, hn::Max(below, above))};
  }

  Point<D> d_;
  Slab x_, y_, z_;
};

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
