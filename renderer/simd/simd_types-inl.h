// Vector types and small helpers shared by the tile stages; compiled once per instruction set.
// Multiply-add is written out as MulAdd, never left to the compiler, so every
// specialisation gives the same bits.
#pragma once

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using I = hn::ScalableTag<std::int32_t>;
using U = hn::ScalableTag<std::uint32_t>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;
using VU = hn::Vec<U>;
using MF = hn::Mask<F>;

constexpr float kLargestHalf = 65504.0f;

constexpr F kF{};
constexpr I kI{};
constexpr U kU{};
constexpr int kLanes = static_cast<int>(hn::MaxLanes(kF));  // 4, 8 or 16 on x86: also the packet width
static_assert(kLanes <= 16);

HWY_INLINE VF set(float x) {
  return hn::Set(kF, x);
}
HWY_INLINE VF load(const float* p) {
  return hn::Load(kF, p);
}
HWY_INLINE VF loadu(const float* p) {
  return hn::LoadU(kF, p);
}

struct V3 {
  VF x, y, z;
};

HWY_INLINE V3 load3(const float* x, const float* y, const float* z) {
  return {load(x), load(y), load(z)};
}
HWY_INLINE V3 set3(const float* v) {
  return {set(v[0]), set(v[1]), set(v[2])};
}
HWY_INLINE VF dot(const V3& a, const V3& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE V3 scale(const V3& a, VF s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
HWY_INLINE V3 sub(const V3& a, const V3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
// a + s * b
HWY_INLINE V3 mul_add(VF s, const V3& b, const V3& a) {
  return {hn::MulAdd(s, b.x, a.x), hn::MulAdd(s, b.y, a.y), hn::MulAdd(s, b.z, a.z)};
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
// Unit vector; a vector of (nearly) no length stays short instead of becoming infinite.
HWY_INLINE V3 normalise(const V3& a) {
  const VF length2 = hn::Max(dot(a, a), set(1e-30f));
  return scale(a, hn::Div(set(1.0f), hn::Sqrt(length2)));
}
HWY_INLINE V3 select(MF m, const V3& yes, const V3& no) {
  return {hn::IfThenElse(m, yes.x, no.x), hn::IfThenElse(m, yes.y, no.y), hn::IfThenElse(m, yes.z, no.z)};
}

// Stores `lanes` of a value and keeps the others. A masked store is microcoded on some CPUs; this is not.
HWY_INLINE void store_lanes(VF value, MF lanes, float* p) {
  hn::Store(hn::IfThenElse(lanes, value, hn::Load(kF, p)), kF, p);
}

// Float ready to be demoted to half with rounding to nearest: Highway's SSE4 demotion cuts
// the low bits off instead.
template <class D, class V>
HWY_INLINE V half_rounded(D d, V value) {
#if HWY_TARGET == HWY_SSE4
  const hn::RebindToUnsigned<D> bits_tag;
  const auto bits = hn::BitCast(bits_tag, value);
  const auto odd = hn::And(hn::ShiftRight<13>(bits), hn::Set(bits_tag, 1u));
  return hn::BitCast(d, hn::Add(bits, hn::Add(odd, hn::Set(bits_tag, 0xfffu))));
#else
  (void)d;
  return value;
#endif
}

// Lanes [0, n).
HWY_INLINE MF first_lanes(int n) {
  return hn::FirstN(kF, static_cast<std::size_t>(n < 0 ? 0 : n));
}

// True where a ray may be handed to Embree, which aborts on NaN, Inf and |x| > 1.8e18.
HWY_INLINE MF traceable(const V3& origin, const V3& direction) {
  const VF size = hn::Add(hn::Add(hn::Abs(origin.x), hn::Add(hn::Abs(origin.y), hn::Abs(origin.z))),
                          hn::Add(hn::Abs(direction.x), hn::Add(hn::Abs(direction.y), hn::Abs(direction.z))));
  return hn::Lt(size, set(1e18f));  // false for NaN
}

// 32 random bits per lane from a key and a counter: the "lowbias32" integer hash (Chris Wellons, 2018).
HWY_INLINE VU hashed(VU h) {
  h = hn::Mul(hn::Xor(h, hn::ShiftRight<16>(h)), hn::Set(kU, 0x7feb352du));
  h = hn::Mul(hn::Xor(h, hn::ShiftRight<15>(h)), hn::Set(kU, 0x846ca68bu));
  return hn::Xor(h, hn::ShiftRight<16>(h));
}
HWY_INLINE VU hash(VU key, std::uint32_t counter) {
  return hashed(hn::Xor(key, hn::Set(kU, counter * 0x9e3779b9u + 0x85ebca6bu)));
}
// The same with a counter of each lane's own.
HWY_INLINE VU hash(VU key, VU counter) {
  const VU spread = hn::Add(hn::Mul(counter, hn::Set(kU, 0x9e3779b9u)), hn::Set(kU, 0x85ebca6bu));
  return hashed(hn::Xor(key, spread));
}
// [0, 1) from the upper 24 bits.
HWY_INLINE VF unit_float(VU bits) {
  return hn::Mul(hn::ConvertTo(kF, hn::BitCast(kI, hn::ShiftRight<8>(bits))), set(0x1p-24f));
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
