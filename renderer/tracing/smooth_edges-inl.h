// Stage: samples at edges become the mean over their own ray and a few further ones. What those meet has
// mostly been lit by a sample nearby, and takes its texel; surfaces that none of them shows, thin things, and
// those that look much different from one sample to the next are lit anew, as samples are. Before: the tile
// is lit. After: its texels are stored. Source of coverage apart from shading: Akeley, "RealityEngine
// Graphics", 1993.
#pragma once

#include "renderer/tiles/place_ranks.h"
#include "renderer/tracing/alpha_layers-inl.h"
#include "renderer/tracing/edge_shadows-inl.h"
#include "renderer/tracing/find_edges-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Lights what packets of rays meet, all layers where surfaces blend (trace_tile-inl.h).
template <SurfaceDetail kDetail, Lobe kLobe>
void light_packets(const TileJob& job, int packets, RayKind kind);

// Remembers the texels of the tile's packets.
HWY_NOINLINE inline void note_texels(const TileJob& job) {
  EdgeSamples& samples = *job.scratch->edges;
  for (int p = 0; p < samples.packets; ++p) {
    const int column = samples.packet_x[static_cast<std::size_t>(p)] - job.x0,
              row = samples.packet_y[static_cast<std::size_t>(p)] - job.y0;
    ResolvedPacket at;
    resolve_packet(job, p, at);
    to_picture(at.texel.light, samples.light, column, row);
    to_picture(at.texel.ratio, samples.ratio, column, row);
  }
}

// Adds up what rays show; `values`: light and ratio, `codes` as EdgeSamples::rays.
HWY_INLINE void add_shown(EdgeSamples& samples, const std::int32_t* codes, int rays,
                          const float (&values)[6][kMaxLanes]) {
  for (int i = 0; i < rays; ++i) {
    const auto sample = static_cast<std::size_t>(codes[i] & 0xffff);
    samples.light_sum.x[sample] += values[0][i];
    samples.light_sum.y[sample] += values[1][i];
    samples.light_sum.z[sample] += values[2][i];
    samples.ratio_sum.x[sample] += values[3][i];
    samples.ratio_sum.y[sample] += values[4][i];
    samples.ratio_sum.z[sample] += values[5][i];
  }
}
HWY_INLINE void add_shown(EdgeSamples& samples, const std::int32_t* codes, int rays, const V3& light,
                          const V3& ratio) {
  alignas(64) float values[6][kMaxLanes];
  const VF channels[6] = {light.x, light.y, light.z, ratio.x, ratio.y, ratio.z};
  for (int c = 0; c < 6; ++c) hn::Store(channels[c], kF, values[c]);
  add_shown(samples, codes, rays, values);
}

// Lists the further rays of samples from `next` on, as many as there is room for; returns the sample after.
// Places away from all edges count as the sample itself.
HWY_NOINLINE inline int queue_edge_rays(const TileJob& job, int next) {
  EdgeSamples& samples = *job.scratch->edges;
  const EdgePlaces& places = *job.grid->edge_places;
  samples.ray_count = samples.lit_anew_count = 0;
  const auto room = [&] {
    return samples.ray_count + samples.lit_anew_count + places.all().count <= kTileRays;
  };
  for (; next < samples.count && room(); ++next) {
    const auto i = static_cast<std::size_t>(next);
    const auto cell = static_cast<std::size_t>(EdgeSamples::at(samples.column[i], samples.row[i]));
    const std::int32_t marks = samples.marks[cell];
    const bool anew = (marks & EdgeSamples::kShadingEdge) != 0;
    const EdgePlaces::Set& set = (marks & EdgeSamples::kStrongEdge) != 0 ? places.all() : places.few();
    int own = 1;
    for (int k = set.first; k < set.first + set.count; ++k) {
      if (anew) {
        samples.rays_lit_anew[static_cast<std::size_t>(samples.lit_anew_count++)] = (k << 16) + next;
      } else if ((marks & (places.sides(k) * EdgeSamples::kFirstSide)) != 0) {
        samples.rays[static_cast<std::size_t>(samples.ray_count++)] = (k << 16) + next;
      } else {
        ++own;
      }
    }
    samples.share[i] = 1.0f / static_cast<float>(1 + set.count);
    const auto times = static_cast<float>(own);
    samples.light_sum.x[i] = times * samples.light.x[cell];
    samples.light_sum.y[i] = times * samples.light.y[cell];
    samples.light_sum.z[i] = times * samples.light.z[cell];
    samples.ratio_sum.x[i] = times * samples.ratio.x[cell];
    samples.ratio_sum.y[i] = times * samples.ratio.y[cell];
    samples.ratio_sum.z[i] = times * samples.ratio.z[cell];
  }
  return next;
}

// Adds rays to the list of those whose hits are lit anew; `cells`: of samples nearby.
HWY_INLINE void push_anew(EdgeSamples& samples, const V3& direction, VI cells, VI code, MF lanes) {
  const auto at = static_cast<std::size_t>(samples.anew_count);
  const auto whole = hn::RebindMask(kI, lanes);
  hn::StoreU(hn::Compress(direction.x, lanes), kF, &samples.anew_direction.x[at]);
  hn::StoreU(hn::Compress(direction.y, lanes), kF, &samples.anew_direction.y[at]);
  hn::StoreU(hn::Compress(direction.z, lanes), kF, &samples.anew_direction.z[at]);
  hn::StoreU(hn::Compress(code, whole), kI, &samples.anew[at]);
  hn::StoreU(hn::Compress(cells, whole), kI, &samples.anew_cell[at]);
  samples.anew_count += static_cast<int>(hn::CountTrue(kF, lanes));
}

// Adds `rays` of a list that count as `cells`, where `counts` is 1 and not 0.
HWY_INLINE void add_cells(EdgeSamples& samples, const std::int32_t* codes, int rays, VI cells, VF counts) {
  add_shown(samples, codes, std::min(rays, kLanes), scale(gather(samples.light, cells), counts),
            scale(gather(samples.ratio, cells), counts));
}

HWY_NOINLINE inline void push_lit_anew(const TileJob& job) {
  EdgeSamples& samples = *job.scratch->edges;
  const int count = samples.lit_anew_count;
  for (int slot = 0; slot < count; slot += kLanes) {
    const EdgeRays rays = edge_rays(job, samples.rays_lit_anew, count, slot);
    const V3 direction = directions_of(*job.grid, rays);
    const MF lanes = hn::And(rays.lanes, traceable(set3(job.grid->origin), direction));
    count_invalid(job, rays.lanes, lanes);
    push_anew(samples, direction, rays.cell, rays.code, lanes);
    // What cannot be traced counts as the sample itself.
    add_cells(samples, &samples.rays_lit_anew[static_cast<std::size_t>(slot)], count - slot, rays.cell,
              hn::IfThenZeroElse(lanes, set(1.0f)));
  }
}

// The listed rays from `slot` on.
template <SurfaceDetail kDetail>
HWY_NOINLINE void trace_edge_rays(const TileJob& job, int slot) {
  EdgeSamples& samples = *job.scratch->edges;
  const EdgeRays rays = edge_rays(job, samples.rays, samples.ray_count, slot);
  const V3 direction = directions_of(*job.grid, rays);
  const MF lanes = hn::And(rays.lanes, traceable(set3(job.grid->origin), direction));
  count_invalid(job, rays.lanes, lanes);
  const SeenSurface met = trace_to_surface<kDetail>(job, direction, rays.key, rays.spread, lanes);
  // What cannot be traced counts as the sample itself.
  VI found = rays.cell;
  MF unseen = lanes;
  find_sample(job, rays, met, nullptr, unseen, found);
  const VI mark = hn::And(gather(samples.marks, found), hn::Set(kI, EdgeSamples::kShadingEdge));
  const MF anew = hn::Or(unseen, hn::And(lanes, hn::RebindMask(kF, hn::Ne(mark, hn::Zero(kI)))));
  look_into_shadows(job, rays, met, hn::AndNot(anew, lanes), found);
  push_anew(samples, direction, found, rays.code, anew);
  add_cells(samples, &samples.rays[static_cast<std::size_t>(slot)], samples.ray_count - slot, found,
            hn::IfThenZeroElse(anew, set(1.0f)));
}

// Makes packets of the rays whose hits are lit anew; returns how many.
HWY_NOINLINE inline int queue_anew(const TileJob& job) {
  TileScratch& scratch = *job.scratch;
  EdgeSamples& samples = *scratch.edges;
  HitBatch& hits = scratch.first;
  const int packets = (samples.anew_count + kLanes - 1) / kLanes;
  const V3 origin = set3(job.grid->origin);
  for (int p = 0; p < packets; ++p) {
    const int slot = p * kLanes;
    const MF used = first_lanes(samples.anew_count - slot);
    const VI code = hn::IfThenElseZero(hn::RebindMask(kI, used), hn::Load(kI, &samples.anew[slot]));
    const VI sample = hn::And(code, hn::Set(kI, 0xffff));
    const VI column = hn::GatherIndex(kI, samples.column.data(), sample),
             row = hn::GatherIndex(kI, samples.row.data(), sample);
    const VI x = hn::Add(column, hn::Set(kI, job.x0)), y = hn::Add(row, hn::Set(kI, job.y0));
    const V3 direction = load3(samples.anew_direction, slot);
    RayHit& packet = packets_of(scratch)[p];
    set_rays(packet, origin, direction);
    const VU key = key_of_place(key_of(*job.grid, x, y), hn::ShiftRight<16>(code));
    hn::Store(key, kU, &hits.key[slot]);
    if (job.shading->plan->voxels) set_chance(packet.ray, key);
    set_valid(scratch.packet_valid[static_cast<std::size_t>(p)].data(), used);
    const VI miss = hn::Set(kI, static_cast<int>(HitKind::miss));
    hn::Store(hn::IfThenElseZero(hn::RebindMask(kI, used), miss), kI, &hits.kind[slot]);
    hn::Store(hn::Zero(kF), kF, &hits.cone_width[slot]);
    hn::Store(spread_at(*job.grid, x), kF, &hits.cone_spread[slot]);
    alignas(64) std::int32_t block[kMaxLanes], place_x[kMaxLanes], place_y[kMaxLanes];
    hn::Store(hn::Add(hn::Mul(hn::ShiftRight<2>(row), hn::Set(kI, kBlocksAlong)), hn::ShiftRight<2>(column)),
              kI, block);
    hn::Store(column, kI, place_x);
    hn::Store(row, kI, place_y);
    for (int i = 0; i < kLanes; ++i) {
      hits.block[static_cast<std::size_t>(slot + i)] = static_cast<std::uint8_t>(block[i]);
      hits.rank[static_cast<std::size_t>(slot + i)] = rank_of_place(place_x[i], place_y[i]);
    }
    // Debug colours alone ask where packets lie: near enough.
    scratch.packet_x[static_cast<std::size_t>(p)] = hn::GetLane(x) & ~3;
    scratch.packet_y[static_cast<std::size_t>(p)] = hn::GetLane(y) & ~3;
    job.counters->rays[RayKind::edge] += static_cast<std::int64_t>(hn::CountTrue(kF, used));
  }
  return packets;
}

// Lights these hits, and adds them to the samples whose rays they are.
template <SurfaceDetail kDetail, Lobe kLobe>
HWY_NOINLINE void light_anew(const TileJob& job) {
  EdgeSamples& samples = *job.scratch->edges;
  if (samples.anew_count == 0) return;
  const int packets = queue_anew(job);
  job.cycles->lap(Stage::edges);
  samples.lights_anew = true;
  light_packets<kDetail, kLobe>(job, packets, RayKind::edge);
  samples.lights_anew = false;
  for (int p = 0; p < packets; ++p) {
    ResolvedPacket at;
    resolve_packet(job, p, at);
    const int slot = p * kLanes;
    add_shown(samples, &samples.anew[static_cast<std::size_t>(slot)],
              std::min(kLanes, samples.anew_count - slot), at.texel.light, at.texel.ratio);
  }
  samples.anew_count = 0;
  job.cycles->lap(Stage::resolve);
}

// Replaces the texels of samples at edges by the means over all their rays.
HWY_NOINLINE inline void take_means(EdgeSamples& samples) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(samples.count); ++i) {
    const auto cell = static_cast<std::size_t>(EdgeSamples::at(samples.column[i], samples.row[i]));
    const float share = samples.share[i];
    samples.light.x[cell] = share * samples.light_sum.x[i];
    samples.light.y[cell] = share * samples.light_sum.y[i];
    samples.light.z[cell] = share * samples.light_sum.z[i];
    samples.ratio.x[cell] = share * samples.ratio_sum.x[i];
    samples.ratio.y[cell] = share * samples.ratio_sum.y[i];
    samples.ratio.z[cell] = share * samples.ratio_sum.z[i];
  }
}

HWY_NOINLINE inline void store_noted(const TileJob& job) {
  const EdgeSamples& samples = *job.scratch->edges;
  for (int p = 0; p < samples.packets; ++p) {
    const int x = samples.packet_x[static_cast<std::size_t>(p)],
              y = samples.packet_y[static_cast<std::size_t>(p)];
    alignas(64) std::int32_t kind[kMaxLanes];
    from_picture(samples.kind, x - job.x0, y - job.y0, kind);
    const Texel texel{from_picture(samples.light, x - job.x0, y - job.y0),
                      from_picture(samples.ratio, x - job.x0, y - job.y0)};
    store_texels(job.grid->sink, x, y, hn::Load(kI, kind), texel);
  }
}

// The whole stage, and the tile's texels: its packets are lit.
template <SurfaceDetail kDetail, Lobe kLobe>
HWY_NOINLINE void smooth_edges(const TileJob& job) {
  EdgeSamples& samples = *job.scratch->edges;
  note_texels(job);
  job.cycles->lap(Stage::resolve);
  find_edges<kDetail>(job);
  for (int next = 0; next < samples.count;) {
    next = queue_edge_rays(job, next);
    if (samples.anew_count + samples.ray_count + samples.lit_anew_count > kTileRays) {
      light_anew<kDetail, kLobe>(job);
    }
    push_lit_anew(job);
    for (int slot = 0; slot < samples.ray_count; slot += kLanes) trace_edge_rays<kDetail>(job, slot);
  }
  light_anew<kDetail, kLobe>(job);
  take_means(samples);
  job.cycles->lap(Stage::edges);
  store_noted(job);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
