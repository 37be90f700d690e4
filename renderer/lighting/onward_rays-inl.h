// Where light that second rays follow goes on: at glass it parts into a refracted and a mirrored ray, each
// with its weight; off the first opaque mirror on its way it is mirrored. Rays wait in a queue (PendingRays).
// No energy is dropped at glass: a share too small to be seen goes along with the other, both go one way
// where the queue has no room for two, and what is not followed any more brings the light from outside along
// its direction. Before: second_rays traced a batch. After: follow_rays takes rays from the queue.
#pragma once

#include <cmath>
#include <cstring>

#include "renderer/lighting/glints-inl.h"
#include "renderer/lighting/second_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Behind the first surface, a share of what is seen below this goes along with the larger one: the rays that
// follow it would be half of all, for 1 / 1000 of the picture.
constexpr float kPartingLimit = 1.0f / 128.0f;
constexpr float kNeverParts = 1e30f;

// What goes on from hits: weights along both directions of the interface.
struct Onward {
  Interface at;
  V3 through, back;
  VF mirror;  // share of the mirrored light that is followed, before Fresnel's
  MF clear, sends_through, sends_back;
};

// `arrives`: weight of the light at the hits. `mirrors`: opaque hits that may send a mirrored ray. Where
// the smaller share at glass is below `parting`, light goes the way that most of it takes. `sharp`: glass
// that mirrors at all does so as a whole, however rough it is.
HWY_INLINE Onward onward_from(const FramePlan& plan, const HitBatch& hits, int slot, const V3& arrives,
                              MF mirrors, float parting, bool sharp) {
  const VF zero = hn::Zero(kF), transmission = load(&hits.transmission[slot]);
  const VF mirror = plan.mirror_rays ? load(&hits.mirror[slot]) : zero;
  const MF object = of_kind(hits, slot, HitKind::object), passes = hn::Gt(transmission, zero);
  Onward out;
  out.clear = hn::And(object, passes);
  out.at = interface_at(hits, slot, plan.surface_details);
  const MF whole = sharp ? hn::Or(out.at.total, hn::Gt(mirror, zero)) : out.at.total;
  const VF mirror_share = hn::IfThenElse(whole, hn::Max(mirror, transmission), mirror);
  out.mirror = hn::IfThenElse(out.clear, mirror_share, mirror);
  V3 back = scale(out.at.reflects, mirror_share);
  const V3 opaque = mirror_weight(plan, hits, slot, dot(load3(hits.normal, slot), load3(hits.viewer, slot)));
  mirrors = hn::AndNot(out.clear, hn::And(mirrors, object));
  back = multiply(arrives, select(out.clear, back, only(mirrors, opaque)));
  V3 through = multiply(arrives, scale(load3(hits.tint, slot), hn::Mul(transmission, out.at.passes)));
  through = only(out.clear, through);
  const VF limit = set(kNegligibleWeight), much_back = largest(back), much_through = largest(through);
  const MF one_way = hn::And(out.clear, hn::Le(hn::Min(much_back, much_through), set(parting)));
  const MF straight = hn::Ge(much_through, much_back);
  const V3 both = add(through, back);
  out.through = select(one_way, only(straight, both), through);
  out.back = select(one_way, only(hn::Not(straight), both), back);
  const MF lanes = hn::Or(out.clear, mirrors);
  out.sends_through = hn::And(lanes, hn::Gt(largest(out.through), limit));
  out.sends_back = hn::And(lanes, hn::Gt(largest(out.back), limit));
  return out;
}

// Appends rays of `lanes` to the queue.
HWY_INLINE void push_pending(PendingRays& pending, const V3& origin, const V3& direction, const V3& weight,
                             const V3& medium, VF width, VI path, MF lanes) {
  const int at = pending.end;
  const auto put = [&](const V3& value, PendingRays::Queue3& to) HWY_ATTR {
    hn::StoreU(hn::Compress(value.x, lanes), kF, to.x.data() + at);
    hn::StoreU(hn::Compress(value.y, lanes), kF, to.y.data() + at);
    hn::StoreU(hn::Compress(value.z, lanes), kF, to.z.data() + at);
  };
  put(origin, pending.origin);
  put(direction, pending.direction);
  put(weight, pending.weight);
  put(medium, pending.medium);
  hn::StoreU(hn::Compress(width, lanes), kF, pending.width.data() + at);
  hn::StoreU(hn::Compress(path, hn::RebindMask(kI, lanes)), kI, pending.path.data() + at);
  pending.end += static_cast<int>(hn::CountTrue(kF, lanes));
}

// Moves what waits to the front of the queue, if otherwise `rays` more would not fit behind it.
HWY_INLINE void make_room(PendingRays& pending, int rays) {
  if (pending.begin == 0 || pending.end + rays <= kMostPending) return;
  const auto count = static_cast<std::size_t>(pending.end - pending.begin);
  const auto from = static_cast<std::size_t>(pending.begin);
  for (PendingRays::Queue3* part : {&pending.origin, &pending.direction, &pending.weight, &pending.medium}) {
    for (auto* lane : {&part->x, &part->y, &part->z}) {
      std::memmove(lane->data(), lane->data() + from, count * sizeof(float));
    }
  }
  std::memmove(pending.width.data(), pending.width.data() + from, count * sizeof(float));
  std::memmove(pending.path.data(), pending.path.data() + from, count * sizeof(std::int32_t));
  pending.begin = 0;
  pending.end = static_cast<int>(count);
}

// The refracted rays of `lanes`; `path` is that of the rays that met the surface.
HWY_INLINE void push_through(PendingRays& pending, const HitBatch& hits, int slot, const Onward& onward,
                             VI path, MF lanes) {
  if (hn::AllFalse(kF, lanes)) return;
  const V3 origin = mul_add(hn::Neg(load(&hits.offset[slot])), load3(hits.geometric_normal, slot),
                            load3(hits.position, slot));
  const V3 medium = only(hn::Not(onward.at.inside), load3(hits.absorption, slot));
  push_pending(pending, origin, onward.at.through, onward.through, medium, load(&hits.cone_width[slot]),
               path_through(path), lanes);
}

// The mirrored rays of `lanes`, in the medium that the light came through.
HWY_INLINE void push_back(PendingRays& pending, const HitBatch& hits, int slot, const Onward& onward,
                          const V3& medium, VI path, MF lanes) {
  if (hn::AllFalse(kF, lanes)) return;
  const VI opaque = hn::IfThenZeroElse(hn::RebindMask(kI, onward.clear), hn::Set(kI, kMirroredPath));
  push_pending(pending, ray_origin(hits, slot), onward.at.back, onward.back, medium,
               load(&hits.cone_width[slot]), hn::Or(path_back(path), opaque), lanes);
}

// Light from outside along `direction` for hits of `lanes`: by the probes around them, where there are any.
HWY_INLINE V3 light_from_outside(const TileJob& job, HitBatch& hits, int slot, MF lanes,
                                 const V3& direction) {
  const ShadingInputs& shading = *job.shading;
  if (shading.probes == nullptr) return environment_radiance(shading, direction);
  const V3 viewer = load3(hits.viewer, slot), normal = load3(hits.normal, slot);
  const V3 side = load3(hits.geometric_normal, slot);
  const MF behind = hn::Lt(dot(side, direction), hn::Zero(kF));
  // A surface there that faces `direction` would receive it.
  store3(direction, hits.viewer, slot), store3(direction, hits.normal, slot);
  store3(select(behind, scale(side, set(-1.0f)), side), hits.geometric_normal, slot);
  ProbeSum sums[1];
  const LookupPoint at = lookup_point(*shading.probes, hits, slot, lanes);
  ask_probes<1>({shading.probes}, at, sums);
  const V3 light = sums[0].radiance(shading, *shading.probes, at);
  store3(viewer, hits.viewer, slot), store3(normal, hits.normal, slot);
  store3(side, hits.geometric_normal, slot);
  return light;
}

// Ends the paths of `lanes`, whose rays are not traced: each brings `weight` times `radiance`. Senders that
// are catchers take nothing that is not virtual.
HWY_INLINE void end_paths(const TileJob& job, VI path, MF lanes, const V3& weight, const V3& radiance) {
  HitBatch& first = job.scratch->first;
  alignas(64) std::int32_t paths[kMaxLanes], ends[kMaxLanes];
  alignas(64) float r[kMaxLanes], g[kMaxLanes], b[kMaxLanes];
  const V3 light = only(lanes, multiply(weight, radiance));
  hn::Store(light.x, kF, r), hn::Store(light.y, kF, g), hn::Store(light.z, kF, b);
  hn::Store(path, kI, paths);
  hn::Store(hn::VecFromMask(kI, hn::RebindMask(kI, lanes)), kI, ends);
  for (std::size_t i = 0; i < static_cast<std::size_t>(kLanes); ++i) {
    if (ends[i] == 0) continue;
    ++job.counters->cut_paths;
    const auto hit = static_cast<std::size_t>(sender_of(paths[i]));
    if (first.kind[hit] == static_cast<int>(HitKind::catcher)) continue;
    first.direct.x[hit] += r[i];
    first.direct.y[hit] += g[i];
    first.direct.z[hit] += b[i];
  }
}

// What rays [0, count) bring is weakened by the medium on their way. Scalar: few rays cross any.
HWY_NOINLINE inline void weaken_on_the_way(TileScratch& scratch, int count) {
  SecondRays& second = *scratch.second;
  const HitBatch& hits = second.hits;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const float lost[3] = {second.medium.x[i], second.medium.y[i], second.medium.z[i]};
    if (!(lost[0] > 0 || lost[1] > 0 || lost[2] > 0)) continue;
    if (hits.kind[i] == static_cast<int>(HitKind::miss)) continue;  // an open body has no end
    const double x = static_cast<double>(hits.position.x[i]) - scratch.queue.origin.x[i],
                 y = static_cast<double>(hits.position.y[i]) - scratch.queue.origin.y[i],
                 z = static_cast<double>(hits.position.z[i]) - scratch.queue.origin.z[i];
    const double length_m = std::sqrt(x * x + y * y + z * z);
    second.weight.x[i] *= static_cast<float>(std::exp(-lost[0] * length_m));
    second.weight.y[i] *= static_cast<float>(std::exp(-lost[1] * length_m));
    second.weight.z[i] *= static_cast<float>(std::exp(-lost[2] * length_m));
  }
}

// What a hit shows of its own after its light went on: clear glass has nothing but lamps in it, and those
// only from without (a body shadows its own inside); the share of mirrored light that was followed is not
// also taken from all sides.
HWY_INLINE void keep_own_light(const ShadingInputs& shading, HitBatch& hits, int slot, const Onward& onward,
                               const V3& arrives, MF mirrors) {
  const VF zero = hn::Zero(kF), transmission = load(&hits.transmission[slot]);
  hn::Store(hn::IfThenElseZero(hn::Or(onward.clear, mirrors), onward.mirror), kF, &hits.mirror[slot]);
  const VF scatters = hn::Add(largest(load3(hits.diffuse, slot)), largest(load3(hits.emission, slot)));
  MF plain = hn::And(hn::And(onward.clear, hn::Le(scatters, zero)), hn::Ge(onward.mirror, transmission));
  if (shading.plan->further_lobes) {
    const VF layers = hn::Add(load(&hits.lobes->coat[slot]), largest(load3(hits.lobes->sheen, slot)));
    plain = hn::And(plain, hn::Le(layers, zero));
  }
  if (hn::AllFalse(kF, plain)) return;
  const MF glints = hn::AndNot(onward.at.inside, may_glint(shading, hits, slot, largest(arrives)));
  const MF silent = hn::AndNot(glints, plain);
  const VI kind = hn::Load(kI, &hits.kind[slot]);
  hn::Store(hn::IfThenZeroElse(hn::RebindMask(kI, silent), kind), kI, &hits.kind[slot]);
}

// Sends the light of rays [0, count), just traced, onward from what they met. The refracted rays of all go
// into the queue before the mirrored ones, so that their order does not depend on the width of vectors.
HWY_NOINLINE inline void send_onward(const TileJob& job, int count) {
  TileScratch& scratch = *job.scratch;
  SecondRays& second = *scratch.second;
  PendingRays& pending = *second.pending;
  HitBatch& hits = second.hits;
  const FramePlan& plan = *job.shading->plan;
  weaken_on_the_way(scratch, count);
  make_room(pending, 2 * count);
  const float parting = pending.end + 2 * count <= kMostPending ? kPartingLimit : kNeverParts;
  for (const bool mirrored_rays : {false, true}) {
    for (int slot = 0; slot < count; slot += kLanes) {
      const MF used = first_lanes(count - slot);
      const MF object = hn::And(used, of_kind(hits, slot, HitKind::object));
      if (hn::AllFalse(kF, object)) continue;
      const VI path = hn::Load(kI, &second.path[slot]);
      const MF last = hn::RebindMask(kF, hn::Gt(path, hn::Set(kI, kLastPath - 1)));
      const MF mirrors = hn::AndNot(
          hn::Or(last, hn::RebindMask(kF, hn::Ne(hn::And(path, hn::Set(kI, kMirroredPath)), hn::Zero(kI)))),
          hn::And(object, hn::Gt(load(&hits.mirror[slot]), hn::Zero(kF))));
      const VF transmission = load(&hits.transmission[slot]);
      const MF sending = hn::Or(hn::And(object, hn::Gt(transmission, hn::Zero(kF))), mirrors);
      const MF may_mirror = plan.mirror_rays ? mirrors : first_lanes(0);
      if (hn::AllFalse(kF, sending)) {
        if (mirrored_rays) store_lanes(hn::Zero(kF), object, &hits.mirror[slot]);
        continue;
      }
      const Onward onward =
          onward_from(plan, hits, slot, load3(second.weight, slot), may_mirror, parting, true);
      const MF through = hn::And(used, onward.sends_through), back = hn::And(used, onward.sends_back);
      if (!mirrored_rays) {
        push_through(pending, hits, slot, onward, path, hn::AndNot(last, through));
        const MF ends = hn::And(hn::And(last, onward.clear), hn::Or(through, back));
        if (hn::AllFalse(kF, ends)) continue;
        const MF straight = hn::Ge(largest(onward.through), largest(onward.back));
        const V3 direction =
            select(ends, select(straight, onward.at.through, onward.at.back), load3(hits.normal, slot));
        const V3 around = light_from_outside(job, hits, slot, ends, direction);
        end_paths(job, path, ends, add(onward.through, onward.back),
                  feed_or(job, load3(hits.position, slot), direction, ends, around));
        continue;
      }
      push_back(pending, hits, slot, onward, load3(second.medium, slot), path, hn::AndNot(last, back));
      keep_own_light(*job.shading, hits, slot, onward, load3(second.weight, slot), may_mirror);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
