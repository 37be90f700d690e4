// The rays that Embree hands to the callbacks of a user geometry: N of them, each field N values long, in the
// object space of the instance. Groups of a whole vector where N allows it, else rays one by one: Embree
// leaves packets for single rays where they are incoherent. Source of the layout: RTCRayHitN in the manual.
#pragma once

#include "renderer/embree/embree_api.h"
#include "renderer/simd/simd_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// As many rays as D has lanes, from ray `first` on. Directions are not normalised.
template <class D>
class CallbackRays {
 public:
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  using Words = hn::RebindToSigned<D>;

  // `rays` points to a RTCRayN, or to a RTCRayHitN where hits are stored.
  HWY_INLINE CallbackRays(void* rays, const int* valid, unsigned n, unsigned first)
      : fields_(static_cast<float*>(rays) + first), n_(n), valid_(valid + first) {}

  HWY_INLINE M valid() const {
    return hn::RebindMask(D(), hn::Ne(hn::LoadU(Words(), valid_), hn::Zero(Words())));
  }
  HWY_INLINE V origin(unsigned axis) const { return field(axis); }
  HWY_INLINE V tnear() const { return field(3); }
  HWY_INLINE V direction(unsigned axis) const { return field(4 + axis); }
  HWY_INLINE V tfar() const { return field(8); }

  HWY_INLINE void set_tfar(M lanes, V t) const { store(8, lanes, t); }
  // u and v are 0.
  HWY_INLINE void set_hit(M lanes, V nx, V ny, V nz, unsigned primitive, unsigned geometry,
                          unsigned instance) const {
    store(kHit + 0, lanes, nx);
    store(kHit + 1, lanes, ny);
    store(kHit + 2, lanes, nz);
    store(kHit + 3, lanes, hn::Zero(D()));
    store(kHit + 4, lanes, hn::Zero(D()));
    store_word(kHit + 5, lanes, primitive);
    store_word(kHit + 6, lanes, geometry);
    store_word(kHit + 7, lanes, instance);
  }

 private:
  static constexpr unsigned kHit = 12;  // fields of a ray; those of its hit follow

  HWY_INLINE V field(unsigned index) const { return hn::LoadU(D(), fields_ + index * n_); }
  HWY_INLINE void store(unsigned index, M lanes, V value) const {
    float* to = fields_ + index * n_;
    hn::StoreU(hn::IfThenElse(lanes, value, hn::LoadU(D(), to)), D(), to);
  }
  HWY_INLINE void store_word(unsigned index, M lanes, unsigned word) const {
    store(index, lanes, hn::BitCast(D(), hn::Set(Words(), static_cast<std::int32_t>(word))));
  }

  float* fields_;
  unsigned n_;
  const int* valid_;
};

// Calls visit(tag, first) until all N rays are covered: whole vectors, then single rays.
template <class Visit>
HWY_INLINE void for_each_group(unsigned n, const Visit& visit) {
  unsigned first = 0;
  for (; first + kLanes <= n; first += kLanes) visit(kF, first);
  for (; first < n; ++first) visit(hn::CappedTag<float, 1>(), first);
}

// Embree 4 reads from `valid` which rays were hit; Embree 3 sees it by tfar.
template <class D>
HWY_INLINE void report_hits(D, int* valid, hn::Mask<D> hits) {
#if RTC_VERSION_MAJOR >= 4
  const hn::RebindToSigned<D> words;
  hn::StoreU(hn::VecFromMask(words, hn::RebindMask(words, hits)), words, valid);
#else
  (void)valid, (void)hits;
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
