// Light samples spent only where they matter. Each hit first looks at a few strata of its own. Where all rays
// of its block agree (on one surface), it sees all of the lamp or nothing. Elsewhere it looks at twice as
// many, and takes the rays of the hits around it or, where what is seen changes fast, where it shines and
// where it has no neighbours, looks at more. What is seen multiplies the light of points
// (light_of_points-inl.h).
#pragma once

#include <algorithm>

#include "renderer/direct_light/light_of_points-inl.h"
#include "renderer/direct_light/share_smoothing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// How often each hit looks at a lamp, by what was seen before.
struct LightRounds {
  // Of hits that ask for rays of their own: as many keep the pictures of the general scene within 0.002 of
  // those with all 64 (RMS, white = 1).
  static constexpr int kOwn = 32;
  int first, mixed, own;

  explicit LightRounds(const LightRecord& light)
      : first(light.first_samples),
        mixed(std::min(light.samples, 2 * first)),
        own(std::min(light.samples, std::max(mixed, kOwn))) {}
};

HWY_INLINE MF is_set(const Lane<float>& lane, int slot) {
  return hn::Gt(load(&lane[slot]), hn::Zero(kF));
}

// Opens the vectors that hold a hit which `wants(slot)` names.
template <typename Wants>
HWY_INLINE void open_vectors(int count, AdaptiveLight& adaptive, const Wants& wants) {
  adaptive.open_count = 0;
  for (int slot = 0; slot < count; slot += kLanes) {
    if (hn::AllFalse(kF, hn::And(wants(slot), first_lanes(count - slot)))) continue;
    adaptive.open_slots[adaptive.open_count++] = static_cast<std::int16_t>(slot);
  }
}

// Highlights whose peak, F0 / (pi alpha^2), outshines a white matte surface: what is wrong with what is seen
// of a lamp shows there most. Catchers have none.
template <Lobe kLobe>
HWY_INLINE MF is_shiny(const HitBatch& hits, int slot) {
  const V3 f0 = load3(hits.f0, slot);
  const MF base = hn::AndNot(of_kind(hits, slot, HitKind::catcher),
                             hn::Gt(hn::Max(f0.x, hn::Max(f0.y, f0.z)), load(&hits.alpha2[slot])));
  if constexpr (kLobe != Lobe::layered) return base;
  const VF of_coat = hn::Mul(set(kCoatF0), load(&hits.lobes->coat[slot]));
  return hn::Or(base, hn::Gt(of_coat, load(&hits.lobes->coat_alpha2[slot])));
}

template <Lobe kLobe>
HWY_NOINLINE void begin(const HitBatch& hits, int count, AdaptiveLight& adaptive) {
  for (int slot = 0; slot < count; slot += kLanes)
    hn::Store(hn::IfThenElseZero(is_shiny<kLobe>(hits, slot), set(1.0f)), kF, &adaptive.shiny[slot]);
  for (Lane<float>* lane : {&adaptive.faced, &adaptive.seen, &adaptive.seen_without, &adaptive.smoothed})
    clear(*lane, count);
  for (auto* sums : {&adaptive.blocked, &adaptive.blocked_without}) {
    clear(sums->count, count);
    for (Lane<float>& lane : sums->places) clear(lane, count);
  }
}

// Adds what was blocked on the way to the lanes' strata.
HWY_INLINE void add_blocked(AdaptiveLight& adaptive, const ShadingPoints& points, VI stratum, VF blocked,
                            VF blocked_without, int slot) {
  if (hn::AllTrue(kF, hn::Eq(hn::Max(blocked, blocked_without), hn::Zero(kF)))) return;
  add_to(adaptive.blocked.count, slot, blocked);
  add_to(adaptive.blocked_without.count, slot, blocked_without);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const VF place = hn::GatherIndex(kF, points.stratum_at[axis].data(), stratum);
    add_to(adaptive.blocked.places[axis], slot, hn::Mul(place, blocked));
    add_to(adaptive.blocked_without.places[axis], slot, hn::Mul(place, blocked_without));
  }
}

// One round: a ray of each hit of the open vectors that `wants(slot)` names, to a stratum of its own. A
// stratum that it does not face counts as blocked.
template <typename Wants>
HWY_INLINE void look_at_strata(const TileJob& job, const LightRecord& light, const ShadingPoints& points,
                               int round, const HitBatch& hits, RayKind kind, const Wants& wants) {
  TileScratch& scratch = *job.scratch;
  AdaptiveLight& adaptive = *scratch.adaptive;
  const LightRound at(light, job.grid->key, round);
  const VF one = set(1.0f);
  begin_light_rays(scratch.queue, light, round);
  for (const int slot : adaptive.open()) {
    const V3 to_light = way_to_stratum(light, at.stratum(light, start_of(adaptive, slot)), hits, slot);
    const MF faces = hn::And(wants(slot), facing(hits, slot, to_light));
    hn::Store(hn::IfThenElseZero(faces, one), kF, &adaptive.faces[slot]);
    hn::Store(hn::IfThenElseZero(faces, one), kF, &scratch.visible[slot]);
    hn::Store(hn::IfThenElseZero(faces, one), kF, &scratch.visible_without[slot]);
    push_shadow_rays(scratch.queue, hits, slot, to_light, faces);
  }
  find_visibility(job, light, hits, kind);
  for (const int slot : adaptive.open()) {
    const VF seen = load(&scratch.visible[slot]), without = load(&scratch.visible_without[slot]);
    if (round < light.first_samples) {
      add_to(adaptive.faced, slot, load(&adaptive.faces[slot]));
      add_to(adaptive.seen, slot, seen);
      add_to(adaptive.seen_without, slot, without);
    }
    const MF wanted = wants(slot);
    add_blocked(adaptive, points, at.stratum(light, start_of(adaptive, slot)),
                hn::IfThenElseZero(wanted, hn::Sub(one, seen)),
                hn::IfThenElseZero(wanted, hn::Sub(one, without)), slot);
  }
}
HWY_NOINLINE inline void look_first(const TileJob& job, const LightRecord& light, const ShadingPoints& points,
                                    int round, const HitBatch& hits, RayKind kind) {
  look_at_strata(job, light, points, round, hits, kind,
                 [](int) HWY_ATTR { return hn::Eq(hn::Zero(kF), hn::Zero(kF)); });
}
// Rounds [from, to) of hits that `which` names and that points shade.
HWY_NOINLINE inline void look_further(const TileJob& job, const LightRecord& light,
                                      const ShadingPoints& points, int from, int to, const Lane<float>& which,
                                      const HitBatch& hits, int count, RayKind kind) {
  AdaptiveLight& adaptive = *job.scratch->adaptive;
  const auto wants = [&](int slot) HWY_ATTR {
    return hn::AndNot(is_set(adaptive.by_samples, slot), is_set(which, slot));
  };
  open_vectors(count, adaptive, wants);
  if (adaptive.open_count == 0) return;
  for (int round = from; round < to; ++round) look_at_strata(job, light, points, round, hits, kind, wants);
}

// What follows the first rounds: more rays of mixed hits, which then take those of their neighbours or ask
// on. `places`: of all rays of hits that ask.
HWY_NOINLINE inline void look_where_mixed(const TileJob& job, const LightRecord& light,
                                          const ShadingPoints& points, const LightRounds& rounds,
                                          const HitBatch& hits, int count, RayKind kind, PlaceSums& places) {
  AdaptiveLight& adaptive = *job.scratch->adaptive;
  BlockSurfaces blocks;
  if (!find_mixed(light, hits, count, blocks, adaptive)) return clear(adaptive.asks, count);
  look_further(job, light, points, rounds.first, rounds.mixed, adaptive.mixed, hits, count, kind);
  places.add(light, points, job.grid->key, 0, rounds.mixed);
  // Only first hits lie in places: what mirrors show has no neighbours, further hits at edges share places.
  if (kind == RayKind::shadow && !(job.scratch->edges && job.scratch->edges->lights_anew)) {
    find_lonely(hits, count, static_cast<float>(rounds.mixed), blocks, adaptive);
    smooth_shares(job, hits, (count + kLanes - 1) / kLanes, rounds.mixed, places);
  } else {
    std::copy_n(adaptive.mixed.begin(), count, adaptive.asks.begin());
  }
  look_further(job, light, points, rounds.mixed, rounds.own, adaptive.asks, hits, count, kind);
  places.add(light, points, job.grid->key, rounds.mixed, rounds.own);
}

// One light at hits [0, count) of a batch.
template <Lobe kLobe>
HWY_NOINLINE void adaptive_light(const TileJob& job, const LightRecord& light, const ShadingPoints& points,
                                 const HighlightUse& use, HitBatch& hits, int count, RayKind kind) {
  AdaptiveLight& adaptive = *job.scratch->adaptive;
  begin<kLobe>(hits, count, adaptive);
  find_starts(job, light, hits, count, adaptive);
  HighlightUse of_points;
  find_use<kLobe>(points.light, hits, count, of_points);
  find_by_samples<kLobe>(light, points, use, of_points, hits, count, adaptive);
  open_vectors(count, adaptive, [](int) HWY_ATTR { return hn::Eq(hn::Zero(kF), hn::Zero(kF)); });
  const LightRounds rounds(light);
  for (int round = 0; round < rounds.first; ++round) look_first(job, light, points, round, hits, kind);

  PlaceSums places;
  look_where_mixed(job, light, points, rounds, hits, count, kind, places);
  shade_points<kLobe>(job, points, of_points, rounds.own, places, hits, count);

  open_vectors(count, adaptive, [&](int slot) HWY_ATTR {
    const MF lit = hn::Or(is_set(adaptive.seen, slot), is_set(adaptive.seen_without, slot));
    return hn::And(is_set(adaptive.by_samples, slot), hn::Or(is_set(adaptive.asks, slot), lit));
  });
  for (int s = 0; s < light.samples && adaptive.open_count > 0; ++s)
    shade_sample<kLobe>(job, light, s, use, hits, kind);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
