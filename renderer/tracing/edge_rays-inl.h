// Further rays through samples at edges, and which of the samples around shows what each meets: coverage
// apart from shading, as in hardware multisampling. Lanes are rays; those of a sample lie side by side, which
// keeps packets narrow. Before: edge_picture. After: find_edges, smooth_edges.
#pragma once

#include "renderer/surfaces/normals-inl.h"
#include "renderer/tracing/back_faces-inl.h"
#include "renderer/tracing/edge_picture-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// As many further rays as fit a packet.
struct EdgeRays {
  MF lanes;
  VI code;    // EdgeSamples::rays
  VI place;   // of the cell
  VI x, y;    // column and row of the sample in the polar buffer
  VI cell;    // its index in pictures
  VU key;     // random numbers: frame, eye, sample and place
  VF spread;  // of their cones
  SeenSurface own;
};

HWY_INLINE VU key_of(const RayGrid& grid, VI x, VI y) {
  return hash(hn::BitCast(kU, hn::Add(hn::ShiftLeft<16>(y), x)), grid.key);
}
HWY_INLINE VF spread_at(const RayGrid& grid, VI x) {
  const VF spread = hn::GatherIndex(kF, grid.samples->spread(), x);
  return hn::Mul(set(grid.ray_width), hn::Max(spread, set(grid.finest_pixel_rad)));
}

HWY_INLINE VI cells_at(VI column, VI row) {
  return hn::Add(hn::Mul(row, hn::Set(kI, EdgeSamples::kStride)),
                 hn::Add(column, hn::Set(kI, EdgeSamples::at(0, 0))));
}

HWY_INLINE VU key_of_place(VU key, VI place) {
  return hash(hn::Xor(key, hn::Mul(hn::BitCast(kU, place), hn::Set(kU, 0x9e3779b1u))), kEdgeSalt);
}

// Those of a list of `count` from `slot` on, a multiple of kLanes.
HWY_INLINE EdgeRays edge_rays(const TileJob& job, const Lane<std::int32_t>& list, int count, int slot) {
  const EdgeSamples& samples = *job.scratch->edges;
  EdgeRays rays;
  rays.lanes = first_lanes(count - slot);
  rays.code =
      hn::IfThenElseZero(hn::RebindMask(kI, rays.lanes), hn::Load(kI, &list[static_cast<std::size_t>(slot)]));
  rays.place = hn::ShiftRight<16>(rays.code);
  const VI sample = hn::And(rays.code, hn::Set(kI, 0xffff));
  const VI column = hn::GatherIndex(kI, samples.column.data(), sample),
           row = hn::GatherIndex(kI, samples.row.data(), sample);
  rays.x = hn::Add(column, hn::Set(kI, job.x0));
  rays.y = hn::Add(row, hn::Set(kI, job.y0));
  rays.cell = cells_at(column, row);
  rays.key = key_of_place(key_of(*job.grid, rays.x, rays.y), rays.place);
  rays.spread = spread_at(*job.grid, rays.x);
  rays.own = seen_at(samples, rays.cell);
  return rays;
}

HWY_INLINE V3 direction_at(const RayGrid& grid, VF sin_theta, VF cos_theta, VF sin_phi, VF cos_phi) {
  const VF a = hn::Mul(sin_theta, cos_phi), b = hn::Mul(sin_theta, sin_phi);
  return mul_add(cos_theta, set3(grid.gaze), mul_add(a, set3(grid.right), scale(set3(grid.up), b)));
}
// Of samples (x, y) of the polar buffer.
HWY_INLINE V3 sample_directions(const RayGrid& grid, VI x, VI y) {
  const PolarSamples& samples = *grid.samples;
  const VI row = hn::ShiftLeft<2>(y);
  return direction_at(
      grid, hn::GatherIndex(kF, samples.sin_theta(), x), hn::GatherIndex(kF, samples.cos_theta(), x),
      hn::GatherIndex(kF, samples.sin_phi4(), row), hn::GatherIndex(kF, samples.cos_phi4(), row));
}
// Through their places of cells.
HWY_INLINE V3 directions_of(const RayGrid& grid, const EdgeRays& rays) {
  const EdgePlaces& places = *grid.edge_places;
  const VI x = hn::Add(hn::Mul(rays.place, hn::Set(kI, places.columns())), rays.x),
           y = hn::Add(hn::Mul(rays.place, hn::Set(kI, places.rows())), rays.y);
  return direction_at(grid, hn::GatherIndex(kF, places.sin_theta(), x),
                      hn::GatherIndex(kF, places.cos_theta(), x), hn::GatherIndex(kF, places.sin_phi(), y),
                      hn::GatherIndex(kF, places.cos_phi(), y));
}

// Rays of `wanted` that are not finite, and so not of `traced`, are counted.
HWY_INLINE void count_invalid(const TileJob& job, MF wanted, MF traced) {
  const auto all = static_cast<std::int64_t>(hn::CountTrue(kF, wanted));
  job.counters->invalid_rays += all - static_cast<std::int64_t>(hn::CountTrue(kF, traced));
}

// What a traced packet met; `backs`: faces of these lanes that eyes do not see.
HWY_INLINE SeenSurface surface_met(const TileJob& job, const RayHit& packet, MF lanes, MF& backs) {
  const VU geometry = hn::Load(kU, packet.hit.geomID), ids = hn::Load(kU, packet.hit.instID[0]);
  const MF hit = hn::And(lanes, hn::RebindMask(kF, hn::Ne(geometry, hn::Set(kU, RTC_INVALID_GEOMETRY_ID))));
  const V3 direction = load3(packet.ray.dir_x, packet.ray.dir_y, packet.ray.dir_z);
  const V3 origin = load3(packet.ray.org_x, packet.ray.org_y, packet.ray.org_z);
  const VF zero = hn::Zero(kF);
  SeenSurface met;
  met.surface =
      hn::IfThenElse(hn::RebindMask(kI, hit), hn::BitCast(kI, ids), hn::Set(kI, EdgeSamples::kMissed));
  met.position = mul_add(hn::IfThenElseZero(hit, load(packet.ray.tfar)), direction, origin);
  met.normal = {zero, zero, zero};
  met.offset = zero;
  MF left = hit;
  backs = first_lanes(0);
  while (!hn::AllFalse(kF, left)) {
    const std::uint32_t id = packet.hit.instID[0][hn::FindFirstTrue(kF, left)];
    const MF of_instance = hn::And(left, hn::RebindMask(kF, hn::Eq(ids, hn::Set(kU, id))));
    left = hn::AndNot(of_instance, left);
    const InstanceRecord& instance = job.shading->instances[id];
    const bool mesh = instance.kind == ShapeKind::mesh;
    const V3 in_object =
        mesh ? object_normal(packet) : load3(packet.hit.Ng_x, packet.hit.Ng_y, packet.hit.Ng_z);
    const V3 n = normal_to_world(instance, in_object);
    const MF away = hn::Gt(dot(n, direction), zero);
    if (mesh && instance.back_face_culling) backs = hn::Or(backs, hn::And(of_instance, away));
    met.normal = select(of_instance, select(away, scale(n, set(-1.0f)), n), met.normal);
  }
  return met;
}

// Traces rays from the eye in the same way as those of samples, up to the surfaces that they meet. `chance`
// decides which voxels they meet.
template <SurfaceDetail kDetail>
HWY_INLINE SeenSurface trace_to_surface(const TileJob& job, const V3& direction, VU chance, VF spread,
                                        MF lanes) {
  const FramePlan& plan = *job.shading->plan;
  alignas(64) RayHit packet;
  alignas(64) int valid[kMaxLanes];
  set_rays(packet, set3(job.grid->origin), direction);
  const bool holes = plan.alpha_mask || plan.alpha_blend;
  if (plan.voxels) set_chance(packet.ray, chance);
  if (holes || plan.back_face_culling) hn::Store(hn::Set(kU, kCullBackFaces), kU, packet.ray.flags);
  if constexpr (kDetail != SurfaceDetail::plain) {
    if (holes || plan.voxels) hn::Store(footprint_code(hn::Zero(kF), spread), kU, packet.ray.id);
  }
  set_valid(valid, lanes);
  job.counters->rays[RayKind::edge] += static_cast<std::int64_t>(hn::CountTrue(kF, lanes));
  record(job, RayKind::edge, packet.ray, valid, true);
  intersect_packet<kLanes>(valid, job.shading->scene, true, &packet);
  for (;;) {
    MF backs;
    const SeenSurface met = surface_met(job, packet, lanes, backs);
    if (hn::AllFalse(kF, backs)) return met;
    pass_backs(job, packet, backs);
  }
}

// Looks for a sample that shows `met`, the ray's own first, then the others around it, nearest first; with
// `blocked` the same lights must be blocked there. Lanes that found one leave `open`.
HWY_INLINE void find_sample(const TileJob& job, const EdgeRays& rays, const SeenSurface& met,
                            const VI* blocked, MF& open, VI& found) {
  const EdgeSamples& samples = *job.scratch->edges;
  const EdgePlaces& places = *job.grid->edge_places;
  const auto take = [&](VI cells, MF shows) HWY_ATTR {
    if (blocked) shows = hn::And(shows, hn::RebindMask(kF, hn::Eq(gather(samples.blocked, cells), *blocked)));
    shows = hn::And(open, shows);
    found = hn::IfThenElse(hn::RebindMask(kI, shows), cells, found);
    open = hn::AndNot(shows, open);
  };
  take(rays.cell, on_one_surface(met, rays.own));
  for (int n = 0; n < EdgePlaces::kNeighbours; ++n) {
    if (hn::AllFalse(kF, open)) return;
    const VI column = hn::GatherIndex(kI, places.neighbour_column(n), rays.place),
             row = hn::GatherIndex(kI, places.neighbour_row(n), rays.place);
    const VI cells = hn::Add(rays.cell, hn::Add(hn::Mul(row, hn::Set(kI, EdgeSamples::kStride)), column));
    const MF same = hn::RebindMask(kF, hn::Eq(gather(samples.surface, cells), met.surface));
    if (hn::AllFalse(kF, hn::And(open, same))) continue;
    take(cells, on_one_surface(met, seen_at(samples, cells)));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
