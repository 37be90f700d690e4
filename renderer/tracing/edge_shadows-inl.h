// Borders of hard shadows: where samples of one surface disagree about a light of one sample, each further
// hit asks for itself and takes the colour of a sample that found the same. Before: edge_rays. After:
// smooth_edges.
#pragma once

#include "renderer/direct_light/shadow_rays-inl.h"
#include "renderer/tracing/edge_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Which of `lanes`, hits `met`, something blocks from the light's only sample.
HWY_NOINLINE inline MF blocked_from(const TileJob& job, const LightRecord& light, const EdgeRays& rays,
                                    const SeenSurface& met, MF lanes) {
  const FramePlan& plan = *job.shading->plan;
  const V3 to_light = light.kind == LightKind::sun ? scale(set3(light.direction), set(-light.reach))
                                                   : sub(set3(light.centre), met.position);
  const V3 origin = mul_add(met.offset, met.normal, met.position);
  const V3 direction = mul_add(hn::Neg(met.offset), met.normal, to_light);
  lanes = hn::And(lanes, hn::Gt(dot(met.normal, to_light), hn::Zero(kF)));
  const MF wanted = lanes;
  lanes = hn::And(lanes, traceable(origin, direction));
  count_invalid(job, wanted, lanes);
  if (hn::AllFalse(kF, lanes)) return lanes;
  alignas(64) Ray packet;
  alignas(64) int valid[kMaxLanes];
  set_rays(packet, origin, direction, kShadowRayEnd, kAllMask);
  if (plan.voxels) {
    const V3 way = sub(met.position, set3(job.grid->origin));
    const VF width = hn::Mul(rays.spread, hn::Sqrt(dot(way, way)));
    const VF length = hn::Sqrt(hn::Max(dot(direction, direction), set(1e-30f)));
    hn::Store(footprint_code(hn::Div(width, length), hn::Zero(kF)), kU, packet.id);
    set_chance(packet, hash(rays.key, light.key));
  }
  set_valid(valid, lanes);
  job.counters->rays[RayKind::edge_shadow] += static_cast<std::int64_t>(hn::CountTrue(kF, lanes));
  record(job, RayKind::edge_shadow, packet, valid, false);
  if (plan.alpha_blend) {
    VF passes = set(1.0f);
    const MF whole = occluded_by_shares(valid, job.shading->scene, lanes, packet, passes);
    return hn::Or(whole, hn::And(lanes, hn::Lt(passes, set(0.5f))));
  }
  occluded_packet<kLanes>(valid, job.shading->scene, &packet);
  return hn::And(lanes, hn::Lt(load(packet.tfar), hn::Zero(kF)));
}

// Lanes that found a sample at the border of a shadow look again, for one that sees the same lights.
HWY_NOINLINE inline void look_into_shadows(const TileJob& job, const EdgeRays& rays, SeenSurface met,
                                           MF lanes, VI& found) {
  const EdgeSamples& samples = *job.scratch->edges;
  const VI safe = hn::IfThenElseZero(hn::RebindMask(kI, lanes), found);
  const VI mark = hn::And(gather(samples.marks, safe), hn::Set(kI, EdgeSamples::kShadowEdge));
  MF asks = hn::And(lanes, hn::RebindMask(kF, hn::Ne(mark, hn::Zero(kI))));
  asks = hn::And(asks, hn::RebindMask(kF, hn::Gt(met.surface, hn::Set(kI, EdgeSamples::kMissed))));
  if (hn::AllFalse(kF, asks)) return;
  met.offset = gather(samples.offset, safe);
  VI blocked = hn::Zero(kI);
  int number = 0;
  for (const LightRecord& light : job.shading->lights) {
    if (number >= kMostEdgeLights) break;
    const VI bit = hn::Set(kI, 1 << number++);
    if (light.samples > 1) continue;
    const MF at = blocked_from(job, light, rays, met, asks);
    blocked = hn::Or(blocked, hn::IfThenElseZero(hn::RebindMask(kI, at), bit));
  }
  MF open = hn::And(asks, hn::RebindMask(kF, hn::Ne(gather(samples.blocked, safe), blocked)));
  if (!hn::AllFalse(kF, open)) find_sample(job, rays, met, &blocked, open, found);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
