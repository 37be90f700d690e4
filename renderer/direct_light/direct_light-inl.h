// Stage: light rays. Direct light of every light at the hits of a batch: N stratified samples per light,
// E = (I / N) sum V cos(theta) / max(d^2, r^2), diffuse and specular; highlights that are narrower than
// strata also by directions drawn from them.
#pragma once

#include "renderer/direct_light/adaptive_light-inl.h"
#include "renderer/direct_light/lobe_samples-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Where edges are looked for: remembers of lights with one sample whether something is in its way, at the
// samples' own hits: not at what mirrors and glass show.
HWY_INLINE void note_blocked(const TileJob& job, const LightRecord& light, int count, RayKind kind) {
  EdgeSamples* edges = job.scratch->edges.get();
  if (edges == nullptr || !edges->notes || light.samples > 1 || kind != RayKind::shadow) return;
  const auto number = static_cast<int>(&light - job.shading->lights.data());
  if (number >= kMostEdgeLights) return;
  const VI bit = hn::Set(kI, 1 << number);
  for (int slot = 0; slot < count; slot += kLanes) {
    const MF blocked = hn::Lt(load(&job.scratch->visible[slot]), set(0.5f));
    std::int32_t* to = &edges->blocked_at[slot];
    hn::Store(hn::Or(hn::Load(kI, to), hn::IfThenElseZero(hn::RebindMask(kI, blocked), bit)), kI, to);
  }
}

// Direct light of every light at hits [0, count) of a batch, whose layers are laid.
template <Lobe kLobe>
HWY_NOINLINE void direct_light(const TileJob& job, HitBatch& hits, int count, RayKind kind) {
  clear(hits.direct, count);
  if (job.shading->plan->catchers) clear(hits.direct_without, count);
  for (const LightRecord& light : job.shading->lights) {
    HighlightUse use;
    find_use<kLobe>(light, hits, count, use);
    if (light.first_samples < light.samples) {
      const auto number = static_cast<std::size_t>(&light - job.shading->lights.data());
      adaptive_light<kLobe>(job, light, job.shading->points[number], use, hits, count, kind);
    } else {
      for (int s = 0; s < light.samples; ++s) {
        queue_shadow_rays(job, light, s, hits, count);
        find_visibility(job, light, hits, kind);
        note_blocked(job, light, count, kind);
        for (int slot = 0; slot < count; slot += kLanes) add_sample<kLobe>(job, light, s, use, hits, slot);
      }
    }
    add_highlights<kLobe>(job, light, use, hits, count, kind);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
