// A tile's way through its stages: rays -> first hits -> surfaces -> light rays -> second rays -> texels.
// This file is compiled once per instruction set (Google Highway's foreach_target); the stages are the -inl
// headers.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/lighting/trace_tile.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include "renderer/lighting/ambient_occlusion-inl.h"
#include "renderer/lighting/resolve-inl.h"
#include "renderer/simd_dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

template <bool kTextures, bool kSpecular>
void trace_tile_with(const TileJob& job) {
  TileScratch& scratch = *job.scratch;
  StageCycles& cycles = *job.cycles;
  const FramePlan& plan = *job.shading->plan;
  RayHit* packets = packets_of(scratch);

  cycles.start();
  const int packet_count = generate_rays(job);
  cycles.lap(Stage::polar_rays);
  if (packet_count == 0) return;

  for (int p = 0; p < packet_count; ++p) {
    const int* valid = scratch.packet_valid[static_cast<std::size_t>(p)].data();
    record(job, RayKind::primary, packets[p].ray, valid, true);
    intersect_packet<kLanes>(valid, job.shading->scene, true, &packets[p]);
  }
  cycles.lap(Stage::first_hits);

  for (int p = 0; p < packet_count; ++p) {
    const VI wanted = hn::Load(kI, &scratch.first.kind[p * kLanes]);
    const MF traced = hn::RebindMask(
        kF, hn::Ne(hn::Load(kI, scratch.packet_valid[static_cast<std::size_t>(p)].data()), hn::Zero(kI)));
    surface_of_packet<kTextures>(packets[p], traced, *job.shading, false, scratch.first, p * kLanes);
    const VI kind = hn::Load(kI, &scratch.first.kind[p * kLanes]);
    hn::Store(hn::IfThenElse(hn::RebindMask(kI, traced), kind, wanted), kI, &scratch.first.kind[p * kLanes]);
  }
  cycles.lap(Stage::surfaces);

  const int count = packet_count * kLanes;
  direct_light<kSpecular>(job, scratch.first, count, RayKind::shadow);
  cycles.lap(Stage::light_rays);
  if (plan.occlusion) {
    ambient_occlusion(job, packet_count);
    cycles.lap(Stage::occlusion);
  }
  if (plan.probes) {
    indirect_light(job, scratch.first, count);
    cycles.lap(Stage::indirect_light);
  }
  if (plan.mirror_rays) reflect_light<kTextures, kSpecular>(job, count);
  if (plan.refraction) refract_light<kTextures, kSpecular>(job, count);
  resolve(job, packet_count);
  cycles.lap(Stage::resolve);
}

void TraceTileKernel(const TileJob& job) {
  const FramePlan& plan = *job.shading->plan;
  if (plan.textures)
    return plan.specular ? trace_tile_with<true, true>(job) : trace_tile_with<true, false>(job);
  return plan.specular ? trace_tile_with<false, true>(job) : trace_tile_with<false, false>(job);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace herr {

HWY_EXPORT(TraceTileKernel);

TraceTile trace_tile_for(Isa isa) {
  return kernel_for(isa, [] { return &HWY_DYNAMIC_DISPATCH(TraceTileKernel); });
}

}  // namespace herr
#endif
