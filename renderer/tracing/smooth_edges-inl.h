// Stage: samples at edges become the mean over their own ray and a few further ones. What those meet has
// mostly been lit by a sample nearby, and takes its texel; surfaces that none of them shows, thin things, and
// those that look much different from one sample to the next are lit anew, as samples are. Before: the tile
// is lit. After: its texels are stored. Source of coverage apart from shading: Akeley, "RealityEngine
// Graphics", 1993.
#pragma once

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

// Adds rays to the list of those whose hits are lit anew; `cells`: of samples nearby.
HWY_INLINE void push_anew(EdgeSamples& samples, const V3& direction, VI cells, int start, int k, MF lanes) {
  const auto at = static_cast<std::size_t>(samples.anew_count);
  const auto whole = hn::RebindMask(kI, lanes);
  hn::StoreU(hn::Compress(direction.x, lanes), kF, &samples.anew_direction.x[at]);
  hn::StoreU(hn::Compress(direction.y, lanes), kF, &samples.anew_direction.y[at]);
  hn::StoreU(hn::Compress(direction.z, lanes), kF, &samples.anew_direction.z[at]);
  const VI code = hn::Add(hn::Iota(kI, 0), hn::Set(kI, start + (k << 16)));
  hn::StoreU(hn::Compress(code, whole), kI, &samples.anew[at]);
  hn::StoreU(hn::Compress(cells, whole), kI, &samples.anew_cell[at]);
  samples.anew_count += static_cast<int>(hn::CountTrue(kF, lanes));
}

// The further rays of samples [start, start + kLanes) of the list.
template <SurfaceDetail kDetail>
HWY_NOINLINE void trace_edge_group(const TileJob& job, int start) {
  EdgeSamples& samples = *job.scratch->edges;
  const EdgeGroup group = edge_group(job, start);
  V3 light = gather(samples.light, group.cell), ratio = gather(samples.ratio, group.cell);
  const V3 origin = set3(job.grid->origin);
  for (int k = 0; k < job.grid->edge_places->count(); ++k) {
    const V3 direction = direction_through(*job.grid, group, k);
    const MF lanes = hn::And(group.lanes, traceable(origin, direction));
    count_invalid(job, group.lanes, lanes);
    const VU chance = hash(group.key, kEdgeSalt + static_cast<std::uint32_t>(k));
    const SeenSurface met = trace_to_surface<kDetail>(job, direction, chance, group.spread, lanes);
    // What cannot be traced counts as the sample itself.
    VI found = group.cell;
    MF unseen = lanes;
    find_sample(job, group, k, met, nullptr, unseen, found);
    const VI mark = hn::And(gather(samples.marks, found), hn::Set(kI, EdgeSamples::kShadingEdge));
    const MF anew = hn::Or(unseen, hn::And(lanes, hn::RebindMask(kF, hn::Ne(mark, hn::Zero(kI)))));
    look_into_shadows(job, group, k, met, hn::AndNot(anew, lanes), found);
    push_anew(samples, direction, found, start, k, anew);
    const V3 more_light = gather(samples.light, found), more_ratio = gather(samples.ratio, found);
    const VF counts = hn::IfThenZeroElse(anew, set(1.0f));
    light = mul_add(counts, more_light, light);
    ratio = mul_add(counts, more_ratio, ratio);
  }
  store3(light, samples.light_sum, start);
  store3(ratio, samples.ratio_sum, start);
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
    const VU place = hn::BitCast(kU, hn::ShiftRight<16>(code));
    const VU key =
        hash(hn::Xor(key_of(*job.grid, x, y), hn::Mul(place, hn::Set(kU, 0x9e3779b1u))), kEdgeSalt);
    hn::Store(key, kU, &hits.key[slot]);
    if (job.shading->plan->voxels) set_chance(packet.ray, key);
    set_valid(scratch.packet_valid[static_cast<std::size_t>(p)].data(), used);
    const VI miss = hn::Set(kI, static_cast<int>(HitKind::miss));
    hn::Store(hn::IfThenElseZero(hn::RebindMask(kI, used), miss), kI, &hits.kind[slot]);
    hn::Store(hn::Zero(kF), kF, &hits.cone_width[slot]);
    hn::Store(spread_at(*job.grid, x), kF, &hits.cone_spread[slot]);
    alignas(64) std::int32_t block[kMaxLanes];
    hn::Store(hn::Add(hn::Mul(hn::ShiftRight<2>(row), hn::Set(kI, kBlocksAlong)), hn::ShiftRight<2>(column)),
              kI, block);
    for (int i = 0; i < kLanes; ++i)
      hits.block[static_cast<std::size_t>(slot + i)] = static_cast<std::uint8_t>(block[i]);
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
    alignas(64) float values[6][kMaxLanes];
    const VF channels[6] = {at.texel.light.x, at.texel.light.y, at.texel.light.z,
                            at.texel.ratio.x, at.texel.ratio.y, at.texel.ratio.z};
    for (int c = 0; c < 6; ++c) hn::Store(channels[c], kF, values[c]);
    const int rays = std::min(kLanes, samples.anew_count - p * kLanes);
    for (int i = 0; i < rays; ++i) {
      const auto sample =
          static_cast<std::size_t>(samples.anew[static_cast<std::size_t>(p * kLanes + i)] & 0xffff);
      samples.light_sum.x[sample] += values[0][i];
      samples.light_sum.y[sample] += values[1][i];
      samples.light_sum.z[sample] += values[2][i];
      samples.ratio_sum.x[sample] += values[3][i];
      samples.ratio_sum.y[sample] += values[4][i];
      samples.ratio_sum.z[sample] += values[5][i];
    }
  }
  samples.anew_count = 0;
  job.cycles->lap(Stage::resolve);
}

// Replaces the texels of samples at edges by the means over all their rays.
HWY_NOINLINE inline void take_means(const TileJob& job) {
  EdgeSamples& samples = *job.scratch->edges;
  const float share = 1.0f / static_cast<float>(1 + job.grid->edge_places->count());
  for (std::size_t i = 0; i < static_cast<std::size_t>(samples.count); ++i) {
    const auto cell = static_cast<std::size_t>(EdgeSamples::at(samples.column[i], samples.row[i]));
    for (Lane<float> Lane3::*from : {&Lane3::x, &Lane3::y, &Lane3::z}) {
      EdgeSamples::Picture<float> EdgeSamples::Picture3::*to = from == &Lane3::x ? &EdgeSamples::Picture3::x
                                                               : from == &Lane3::y
                                                                   ? &EdgeSamples::Picture3::y
                                                                   : &EdgeSamples::Picture3::z;
      (samples.light.*to)[cell] = share * (samples.light_sum.*from)[i];
      (samples.ratio.*to)[cell] = share * (samples.ratio_sum.*from)[i];
    }
  }
}

// The whole stage, and the tile's texels: its packets are lit.
template <SurfaceDetail kDetail, Lobe kLobe>
HWY_NOINLINE void smooth_edges(const TileJob& job) {
  EdgeSamples& samples = *job.scratch->edges;
  note_texels(job);
  job.cycles->lap(Stage::resolve);
  find_edges<kDetail>(job);
  const int most = job.grid->edge_places->count() * kLanes;
  for (int start = 0; start < samples.count; start += kLanes) {
    if (samples.anew_count + most > kTileRays) light_anew<kDetail, kLobe>(job);
    trace_edge_group<kDetail>(job, start);
  }
  light_anew<kDetail, kLobe>(job);
  take_means(job);
  job.cycles->lap(Stage::edges);
  store_noted(job);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
