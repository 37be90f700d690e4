// How wide a ray is: what it stands for along its way, so that voxels are traversed at the level of
// detail that it asks for. Two numbers travel through Embree in the ray's id, 16 bits each (the upper
// half of a float's bits without its sign): the width at the origin and what it grows by per unit of t,
// both over the direction's length, since instances scale directions and positions alike. 0 is a ray
// without width: full detail.
#pragma once

#include "renderer/embree/embree_api.h"
#include "renderer/simd/simd_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Both >= 0; cut to 9 significant bits.
HWY_INLINE VU footprint_code(VF width, VF growth) {
  const VU low = hn::ShiftRight<15>(hn::BitCast(kU, width)),
           high = hn::ShiftRight<15>(hn::BitCast(kU, growth));
  return hn::Or(low, hn::ShiftLeft<16>(high));
}
HWY_INLINE VF footprint_width(VU code) {
  return hn::BitCast(kF, hn::ShiftLeft<15>(hn::And(code, hn::Set(kU, 0xffffu))));
}
HWY_INLINE VF footprint_growth(VU code) {
  return hn::BitCast(kF, hn::ShiftLeft<15>(hn::ShiftRight<16>(code)));
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
