// A tile's way through its stages: rays -> first hits -> surfaces -> light rays -> second rays -> texels.
// The stages are the other -inl headers. Compiled once for each instruction set
// (simd/kernel_instance.cpp.in).
#pragma once

#include "renderer/lighting/ambient_occlusion-inl.h"
#include "renderer/tiles/finite_lanes.h"
#include "renderer/tiles/ray_cones-inl.h"
#include "renderer/tracing/alpha_layers-inl.h"
#include "renderer/tracing/back_faces-inl.h"
#include "renderer/tracing/smooth_edges-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// The nearest surfaces that the packets' rays meet, lit.
template <SurfaceDetail kDetail, Lobe kLobe>
HWY_NOINLINE void trace_layer(const TileJob& job, int packet_count, RayKind kind) {
  TileScratch& scratch = *job.scratch;
  StageCycles& cycles = *job.cycles;
  const FramePlan& plan = *job.shading->plan;
  RayHit* packets = packets_of(scratch);
  const auto traced_lanes = [&](int p) HWY_ATTR {
    return hn::RebindMask(
        kF, hn::Ne(hn::Load(kI, scratch.packet_valid[static_cast<std::size_t>(p)].data()), hn::Zero(kI)));
  };
  const bool sparse = kind == RayKind::behind;  // few packets have anything behind what blends
  for (int p = 0; p < packet_count; ++p) {
    if (sparse && hn::AllFalse(kF, traced_lanes(p))) continue;
    const int* valid = scratch.packet_valid[static_cast<std::size_t>(p)].data();
    const bool holes = plan.alpha_mask || plan.alpha_blend;
    if (holes || plan.back_face_culling) hn::Store(hn::Set(kU, kCullBackFaces), kU, packets[p].ray.flags);
    if constexpr (kDetail != SurfaceDetail::plain) {
      if (holes || plan.voxels) widen(packets[p].ray, scratch.first, p * kLanes);
    }
    record(job, kind, packets[p].ray, valid, true);
    intersect_packet<kLanes>(valid, job.shading->scene, true, &packets[p]);
  }
  cycles.lap(Stage::first_hits);

  for (int p = 0; p < packet_count; ++p) {
    const MF traced = traced_lanes(p);
    if (sparse && hn::AllFalse(kF, traced)) continue;
    const VI wanted = hn::Load(kI, &scratch.first.kind[p * kLanes]);
    surface_seen<kDetail>(job, p, traced);
    if (kind == RayKind::primary) {
      const MF object = hn::And(traced, of_kind(scratch.first, p * kLanes, HitKind::object));
      job.counters->object_samples += static_cast<std::int64_t>(hn::CountTrue(kF, object));
    }
    const VI kind_of_hit = hn::Load(kI, &scratch.first.kind[p * kLanes]);
    hn::Store(hn::IfThenElse(hn::RebindMask(kI, traced), kind_of_hit, wanted), kI,
              &scratch.first.kind[p * kLanes]);
    if (scratch.edges && scratch.edges->notes) note_surfaces(job, p);
  }
  cycles.lap(Stage::surfaces);

  const int count = packet_count * kLanes;
  require_finite(scratch.first, count, Stage::surfaces, plan);
  if (plan.gloss) prepare_gloss(plan, scratch.first, count, plan.mirror_rays);
  if constexpr (kLobe == Lobe::layered) cover_bases(scratch.first, count);
  direct_light<kLobe>(job, scratch.first, count, RayKind::shadow);
  cycles.lap(Stage::light_rays);
  require_finite(scratch.first, count, Stage::light_rays, plan);
  if (plan.occlusion) {
    ambient_occlusion(job, packet_count);
    cycles.lap(Stage::occlusion);
    require_finite(scratch.first, count, Stage::occlusion, plan);
  }
  if (plan.probes) {
    indirect_light(job, scratch.first, count);
    cycles.lap(Stage::indirect_light);
    require_finite(scratch.first, count, Stage::indirect_light, plan);
  }
  if (plan.filtered_environment) {
    show_environment(*job.shading, scratch.first, count);
    cycles.lap(Stage::indirect_light);
    require_finite(scratch.first, count, Stage::indirect_light, plan);
  }
  if (plan.refraction) set_ray_budget(job, count);
  if (plan.mirror_rays) reflect_light<kDetail, kLobe>(job, count);
  if (plan.refraction) refract_light<kDetail, kLobe>(job, count);
  if (plan.mirror_rays || plan.refraction) require_finite(scratch.first, count, Stage::second_light, plan);
}

template <SurfaceDetail kDetail, Lobe kLobe>
HWY_NOINLINE void light_packets(const TileJob& job, int packets, RayKind kind) {
  const bool blends = job.shading->plan->alpha_blend;
  if (blends) begin_layers(job, packets);
  for (int layer = 1; layer <= kMostLayers; ++layer) {
    trace_layer<kDetail, kLobe>(job, packets, layer == 1 ? kind : RayKind::behind);
    if (job.scratch->edges && job.scratch->edges->notes) note_light(job);
    if (!blends) return;
    const bool more = add_layer(job, packets, layer == kMostLayers);
    job.cycles->lap(Stage::resolve);
    if (!more) return;
  }
}

template <SurfaceDetail kDetail, Lobe kLobe>
HWY_NOINLINE void trace_tile_with(const TileJob& job) {
  StageCycles& cycles = *job.cycles;
  cycles.start();
  const int packet_count = generate_rays(job);
  cycles.lap(Stage::polar_rays);
  if (packet_count == 0) return;

  if constexpr (kDetail != SurfaceDetail::plain || kLobe != Lobe::none) set_up_cones(job, packet_count);
  const bool edges = job.grid->edge_places != nullptr;
  if (edges) begin_edges(job, packet_count);
  light_packets<kDetail, kLobe>(job, packet_count, RayKind::primary);
  if (edges) {
    smooth_edges<kDetail, kLobe>(job);
  } else {
    resolve(job, packet_count);
  }
  cycles.lap(Stage::resolve);
}

void trace_tile(const TileJob& job) {
  const FramePlan& plan = *job.shading->plan;
  if (plan.further_lobes) return trace_tile_with<SurfaceDetail::all, Lobe::layered>(job);
  if (plan.surface_details) return trace_tile_with<SurfaceDetail::all, Lobe::weighted>(job);
  if (plan.textures || plan.voxels) return trace_tile_with<SurfaceDetail::textures, Lobe::usual>(job);
  return plan.specular ? trace_tile_with<SurfaceDetail::plain, Lobe::usual>(job)
                       : trace_tile_with<SurfaceDetail::plain, Lobe::none>(job);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
