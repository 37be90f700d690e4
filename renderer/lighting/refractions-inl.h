// Stage: second rays by refraction. Light that passes transparent surfaces is followed from interface
// to interface by Snell's law, mirrored where it is reflected totally, until it meets something opaque
// or leaves the scene; that is lit like a first hit. At each interface the share 1 - F (Schlick) times
// the base colour goes on.
#pragma once

#include <utility>

#include "renderer/lighting/reflections-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

struct Refraction {
  V3 direction;  // refracted, or mirrored where reflection is total
  MF total;      // total internal reflection
  VF passes;     // share that goes on: 1 - F, or 1 where reflection is total
};

// `eta`: index of the viewer's side over that of the other; `f0`: reflectance at normal incidence.
HWY_INLINE Refraction refract(const V3& v, const V3& n, const V3& g, VF eta, VF f0) {
  const VF one = set(1.0f), zero = hn::Zero(kF);
  const VF cosine = hn::Min(hn::Max(dot(n, v), zero), one);
  const VF sine2 = hn::Mul(hn::Mul(eta, eta), hn::NegMulAdd(cosine, cosine, one));
  const VF below2 = hn::Sub(one, sine2);  // squared cosine on the other side
  Refraction out;
  out.total = hn::Le(below2, zero);
  const VF below = hn::Sqrt(hn::Max(below2, zero));
  // eta (-v) + (eta cos - cos') n
  const V3 straight = scale(v, hn::Neg(eta));
  V3 through = mul_add(hn::MulSub(eta, cosine, below), n, straight);
  // An interpolated normal can leave the ray on the viewer's side: it then goes straight on.
  through = select(hn::Lt(dot(through, g), zero), through, scale(v, set(-1.0f)));
  out.direction = select(out.total, mirrored(v, n, g), normalise(through));
  // Schlick's angle is the one in the thinner medium.
  const VF angle = schlick_weight(hn::IfThenElse(hn::Gt(eta, one), below, cosine));
  // What has (nearly) no step of the index reflects nothing at grazing angles either,
  // as Schlick's curve would.
  const VF grazing = hn::Mul(angle, hn::Min(hn::Mul(f0, set(1e4f)), one));
  out.passes = hn::IfThenElse(out.total, one, hn::NegMulAdd(hn::Sub(one, f0), grazing, hn::Sub(one, f0)));
  return out;
}

// Sends light of hits [0, count) of a batch onward through their surfaces, into the queue `onward`.
// `senders(slot)`: the first hits they belong to, whose weights are set at the first interface and multiplied
// at later ones. Behind the first interface, a hit that lets its light through gets the kind `none`: its own
// light is not added.
template <typename Senders>
HWY_NOINLINE void queue_refractions(const TileJob& job, HitBatch& hits, int count, bool first_interface,
                                    const Senders& senders) {
  SecondRays& second = *job.scratch->second;
  RayQueue& onward = second.onward;
  onward.count = 0;
  alignas(64) std::int32_t sends[kMaxLanes], sender[kMaxLanes];
  alignas(64) float r[kMaxLanes], g[kMaxLanes], b[kMaxLanes];
  for (int slot = 0; slot < count; slot += kLanes) {
    const VF transmission = load(&hits.transmission[slot]);
    const MF clear_hits = hn::And(of_kind(hits, slot, HitKind::object), hn::Gt(transmission, hn::Zero(kF)));
    if (hn::AllFalse(kF, clear_hits)) continue;
    const V3 v = load3(hits.viewer, slot);
    const V3 n = load3(hits.normal, slot);
    const V3 gn = load3(hits.geometric_normal, slot);
    const V3 tint = load3(hits.tint, slot);
    const Refraction way = refract(v, n, gn, load(&hits.index_ratio[slot]), load(&hits.dielectric_f0[slot]));
    const VF share = hn::Mul(transmission, way.passes);
    const V3 weight = scale(tint, share);
    const MF go_on = hn::And(clear_hits, hn::Gt(largest(weight), set(kNegligibleWeight)));
    hn::Store(weight.x, kF, r), hn::Store(weight.y, kF, g), hn::Store(weight.z, kF, b);
    const VI senders_of = senders(slot);
    hn::Store(senders_of, kI, sender);
    hn::Store(hn::VecFromMask(kI, hn::RebindMask(kI, go_on)), kI, sends);
    for (std::size_t i = 0; i < static_cast<std::size_t>(kLanes); ++i) {
      if (sends[i] == 0) continue;
      const auto hit = static_cast<std::size_t>(sender[i]);
      second.weight.x[hit] = (first_interface ? 1.0f : second.weight.x[hit]) * r[i];
      second.weight.y[hit] = (first_interface ? 1.0f : second.weight.y[hit]) * g[i];
      second.weight.z[hit] = (first_interface ? 1.0f : second.weight.z[hit]) * b[i];
    }
    // From the far side of the surface, or from this one where the light turns back.
    const VF offset = load(&hits.offset[slot]);
    const V3 p = load3(hits.position, slot);
    const V3 origin = mul_add(hn::IfThenElse(way.total, offset, hn::Neg(offset)), gn, p);
    push(onward, origin, way.direction, senders_of, go_on);
    if (!first_interface) {
      const VI kind = hn::Load(kI, &hits.kind[slot]);
      hn::Store(hn::IfThenZeroElse(hn::RebindMask(kI, go_on), kind), kI, &hits.kind[slot]);
    }
  }
}

// The whole stage for first hits [0, count).
template <SurfaceDetail kDetail, Lobe kLobe>
HWY_NOINLINE void refract_light(const TileJob& job, int count) {
  TileScratch& scratch = *job.scratch;
  SecondRays& second = *scratch.second;
  const VI lane = hn::Iota(kI, 0);
  queue_refractions(job, scratch.first, count, true,
                    [&](int slot) HWY_ATTR { return hn::Add(lane, hn::Set(kI, slot)); });
  for (int interface = 1; second.onward.count > 0 && interface <= kMostInterfaces; ++interface) {
    std::swap(scratch.queue, second.onward);
    const int rays = scratch.queue.count;
    remember_senders(scratch);
    trace_second_rays<kDetail>(job, RayKind::refraction, 0x2545f491u + static_cast<std::uint32_t>(interface));
    second.onward.count = 0;
    if (interface < kMostInterfaces) {
      queue_refractions(job, second.hits, rays, false,
                        [&](int slot) HWY_ATTR { return hn::LoadU(kI, &second.sender[slot]); });
    }
    job.cycles->lap(Stage::second_hits);
    direct_light<kLobe>(job, second.hits, rays, RayKind::refraction_shadow);
    light_indirectly(job, rays);
    gather_second_light(job, rays);
    job.cycles->lap(Stage::second_light);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
