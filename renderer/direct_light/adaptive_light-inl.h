// Light samples spent only where they matter. The first few are traced for every hit, the others only in 4x4
// blocks whose first samples disagree (refinement where samples differ: Mitchell 1987). There, samples run
// from a coarse lattice of strata to the finer ones, and a stratum whose neighbours all agree is not asked:
// only those along the edge of what hides the light are. What is seen multiplies the light of points
// (light_of_points-inl.h).
#pragma once

#include <algorithm>
#include <array>

#include "renderer/direct_light/light_of_points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// The samples before `s` whose strata touch that of sample `s`, by a face, an edge or a corner.
struct KnownNeighbours {
  std::array<std::uint16_t, 26> sample;
  int count = 0;
};
HWY_INLINE KnownNeighbours known_neighbours(const LightRecord& light, int s) {
  const int nx = light.strata[0], ny = light.strata[1], nz = light.strata[2];
  const int stratum = stratum_of(light, s);
  const int x = stratum % nx, y = stratum / nx % ny, z = stratum / (nx * ny);
  KnownNeighbours known;
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int ox = x + dx, oy = y + dy, oz = z + dz;
        if (ox < 0 || oy < 0 || oz < 0 || ox >= nx || oy >= ny || oz >= nz) continue;
        const std::uint16_t other = light.sample_of[static_cast<std::size_t>(ox + nx * (oy + ny * oz))];
        if (other < s) known.sample[static_cast<std::size_t>(known.count++)] = other;
      }
    }
  }
  return known;
}

// Of the neighbours, how many each hit of a vector sees.
HWY_INLINE VI sum_seen(const std::array<Lane<std::uint8_t>, kMostOrderedSamples>& saw,
                       const KnownNeighbours& known, int slot) {
  const hn::Rebind<std::uint8_t, I> bytes;
  auto total = hn::Zero(bytes);
  for (int n = 0; n < known.count; ++n) {
    const std::size_t sample = known.sample[static_cast<std::size_t>(n)];
    total = hn::Add(total, hn::LoadU(bytes, saw[sample].data() + slot));
  }
  return hn::PromoteTo(kI, total);
}

// Foretells sample `s` of undecided hits where all the strata around it that are known agree: the edge of
// what hides the light does not pass there. Takes three of them at least. Elsewhere undecided hits ask.
HWY_NOINLINE inline void predict(const TileJob& job, const LightRecord& light, int s) {
  AdaptiveLight& adaptive = *job.scratch->adaptive;
  const bool catchers = job.shading->plan->catchers_occlude && !light.is_virtual;
  const KnownNeighbours known = known_neighbours(light, s);
  const VF one = set(1.0f), zero = hn::Zero(kF);
  const VI none = hn::Zero(kI), all = hn::Set(kI, known.count);
  const auto as_float = [&](auto lanes)
                            HWY_ATTR { return hn::IfThenElseZero(hn::RebindMask(kF, lanes), one); };
  for (const int slot : adaptive.open()) {
    const MF undecided = hn::Gt(load(&adaptive.undecided[slot]), zero);
    const VI sum = sum_seen(adaptive.saw, known, slot);
    const VI without = catchers ? sum_seen(adaptive.saw_without, known, slot) : all;
    const auto same = [&](VI seen) HWY_ATTR { return hn::Or(hn::Eq(seen, none), hn::Eq(seen, all)); };
    MF predicted = hn::And(hn::RebindMask(kF, hn::And(same(sum), same(without))),
                           hn::Eq(load(&adaptive.glossy[slot]), zero));
    if (known.count < 3) predicted = first_lanes(0);
    hn::Store(hn::IfThenElseZero(hn::AndNot(predicted, undecided), one), kF, &adaptive.asks[slot]);
    store_lanes(as_float(hn::Ne(sum, none)), undecided, &adaptive.agreed[slot]);
    store_lanes(catchers ? as_float(hn::Ne(without, none)) : one, undecided, &adaptive.agreed_without[slot]);
  }
}

// Lanes 2k and 2k + 1 exchanged: neighbouring columns of a 4x4 block.
HWY_INLINE VF swap_pairs(VF v) {
  return hn::Shuffle2301(v);
}
HWY_INLINE MF swap_pairs(MF m) {
  return hn::MaskFromVec(hn::Shuffle2301(hn::VecFromMask(kF, m)));
}

// Hits that may share their first samples: the same kind of surface, turned alike, in one plane, not glossy.
HWY_NOINLINE inline void find_pairs(const HitBatch& hits, int count, AdaptiveLight& adaptive) {
  for (int slot = 0; slot < count; slot += kLanes) {
    const V3 n = load3(hits.normal, slot);
    const V3 g = load3(hits.geometric_normal, slot);
    const V3 p = load3(hits.position, slot);
    const V3 other_n{swap_pairs(n.x), swap_pairs(n.y), swap_pairs(n.z)};
    const V3 gap = sub(V3{swap_pairs(p.x), swap_pairs(p.y), swap_pairs(p.z)}, p);
    const VF kind = hn::ConvertTo(kF, hn::Load(kI, &hits.kind[slot]));
    const MF glossy = is_glossy(hits, slot);
    hn::Store(hn::IfThenElseZero(glossy, set(1.0f)), kF, &adaptive.glossy[slot]);
    const MF turned = hn::Gt(dot(n, other_n), set(0.95f));
    const MF same_kind = hn::AndNot(hn::Or(glossy, swap_pairs(glossy)), hn::Eq(kind, swap_pairs(kind)));
    const MF alike = hn::And(turned, same_kind);
    const VF height = dot(gap, g);
    const MF level = hn::Le(hn::Mul(height, height), hn::Mul(set(0.01f), dot(gap, gap)));
    hn::Store(hn::IfThenElseZero(hn::And(alike, hn::And(level, swap_pairs(level))), set(1.0f)), kF,
              &adaptive.paired[slot]);
  }
}

// Hits that take first sample `s` from their neighbour's ray: even ones the odd samples,
// odd ones the even samples.
HWY_INLINE MF borrows(const AdaptiveLight& adaptive, int s, int slot, MF lit) {
  const VI odd = hn::And(hn::Iota(kI, 0), hn::Set(kI, 1));
  const MF not_mine = hn::RebindMask(kF, hn::Ne(odd, hn::Set(kI, s & 1)));
  const MF paired = hn::Gt(load(&adaptive.paired[slot]), hn::Zero(kF));
  return hn::And(hn::And(lit, swap_pairs(lit)), hn::And(paired, not_mine));
}

// Finds what hits see of one of the first samples: by a ray, or from the ray of the neighbour.
HWY_NOINLINE inline void first_visibility(const TileJob& job, const LightRecord& light, int s,
                                          const HitBatch& hits, int count, RayKind kind) {
  TileScratch& scratch = *job.scratch;
  const AdaptiveLight& adaptive = *scratch.adaptive;
  begin_light_rays(scratch.queue, light, s);
  for (int slot = 0; slot < count; slot += kLanes) {
    hn::Store(set(1.0f), kF, &scratch.visible[slot]);
    hn::Store(set(1.0f), kF, &scratch.visible_without[slot]);
    const V3 to_light = way_to_light(light, s, hits, slot);
    const MF lit = facing(hits, slot, to_light);
    push_shadow_rays(scratch.queue, hits, slot, to_light, hn::AndNot(borrows(adaptive, s, slot, lit), lit));
  }
  find_visibility(job, light, hits, kind);
  for (int slot = 0; slot < count; slot += kLanes) {
    const MF lit = facing(hits, slot, way_to_light(light, s, hits, slot));
    const MF borrowed = borrows(adaptive, s, slot, lit);
    const VF visible = load(&scratch.visible[slot]), without = load(&scratch.visible_without[slot]);
    hn::Store(hn::IfThenElse(borrowed, swap_pairs(visible), visible), kF, &scratch.visible[slot]);
    hn::Store(hn::IfThenElse(borrowed, swap_pairs(without), without), kF, &scratch.visible_without[slot]);
  }
}

// Finds what hits see of a later sample: by a ray where a hit asks, else by what was decided or predicted.
HWY_NOINLINE inline void later_visibility(const TileJob& job, const LightRecord& light, int s,
                                          const HitBatch& hits, RayKind kind) {
  TileScratch& scratch = *job.scratch;
  const AdaptiveLight& adaptive = *scratch.adaptive;
  begin_light_rays(scratch.queue, light, s);
  for (const int slot : adaptive.open()) {
    const MF asks = hn::Gt(load(&adaptive.asks[slot]), hn::Zero(kF));
    const VF one = set(1.0f);
    hn::Store(hn::IfThenElse(asks, one, load(&adaptive.agreed[slot])), kF, &scratch.visible[slot]);
    hn::Store(hn::IfThenElse(asks, one, load(&adaptive.agreed_without[slot])), kF,
              &scratch.visible_without[slot]);
    if (hn::AllFalse(kF, asks)) continue;
    const V3 to_light = way_to_light(light, s, hits, slot);
    push_shadow_rays(scratch.queue, hits, slot, to_light, hn::And(asks, facing(hits, slot, to_light)));
  }
  find_visibility(job, light, hits, kind);
}

// Writes down what each hit saw of sample `s`: for predictions and decisions, and for the light of its point.
HWY_NOINLINE inline void note_seen(const TileJob& job, const LightRecord& light, int point, int s,
                                   const HitBatch& hits) {
  TileScratch& scratch = *job.scratch;
  AdaptiveLight& adaptive = *scratch.adaptive;
  std::uint8_t* saw = adaptive.saw[static_cast<std::size_t>(s)].data();
  std::uint8_t* saw_without = adaptive.saw_without[static_cast<std::size_t>(s)].data();
  Lane<float>& of_point = adaptive.of_point[static_cast<std::size_t>(point)];
  Lane<float>& of_point_without = adaptive.of_point_without[static_cast<std::size_t>(point)];
  const bool first = s < light.first_samples;
  const hn::Rebind<std::uint8_t, I> bytes;
  const auto put = [&](VF share, std::uint8_t* to)
                       HWY_ATTR { hn::StoreU(hn::DemoteTo(bytes, hn::ConvertTo(kI, share)), bytes, to); };
  for (const int slot : adaptive.open()) {
    const MF lit = facing(hits, slot, way_to_light(light, s, hits, slot));
    const VF seen = hn::IfThenElseZero(lit, load(&scratch.visible[slot]));
    const VF without = hn::IfThenElseZero(lit, load(&scratch.visible_without[slot]));
    put(seen, saw + slot);
    put(without, saw_without + slot);
    add_to(of_point, slot, seen);
    add_to(of_point_without, slot, without);
    if (!first) continue;
    add_to(adaptive.faced, slot, hn::IfThenElseZero(lit, set(1.0f)));
    add_to(adaptive.seen, slot, seen);
    add_to(adaptive.seen_without, slot, without);
  }
}

// Decides for each hit, from the first samples, whether it sees all of the light, nothing of it, or
// must ask on: where samples within its 4x4 block disagree. Blocks are the same on every instruction
// set, and so is the decision.
HWY_NOINLINE inline void decide(const HitBatch& hits, int count, AdaptiveLight& adaptive) {
  enum : std::uint8_t { kDark = 1, kBright = 2, kMixed = kDark | kBright };
  std::array<std::uint8_t, kBlocksInTile> with{}, without{};
  const auto state = [](float seen, float faced) -> std::uint8_t {
    if (faced == 0) return 0;
    return seen == 0 ? kDark : seen == faced ? kBright : kMixed;
  };
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    with[hits.block[i]] |= state(adaptive.seen[i], adaptive.faced[i]);
    without[hits.block[i]] |= state(adaptive.seen_without[i], adaptive.faced[i]);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const bool mixed =
        with[hits.block[i]] == kMixed || without[hits.block[i]] == kMixed || adaptive.glossy[i] != 0;
    adaptive.undecided[i] = mixed ? 1.0f : 0.0f;
    adaptive.agreed[i] = adaptive.seen[i] > 0 ? 1.0f : 0.0f;
    adaptive.agreed_without[i] = adaptive.seen_without[i] > 0 ? 1.0f : 0.0f;
  }
}

HWY_NOINLINE inline void begin(int count, AdaptiveLight& adaptive) {
  adaptive.open_count = 0;
  for (int slot = 0; slot < count; slot += kLanes)
    adaptive.open_slots[adaptive.open_count++] = static_cast<std::int16_t>(slot);
  for (Lane<float>* lane : {&adaptive.faced, &adaptive.seen, &adaptive.seen_without}) clear(*lane, count);
  for (Lane<float>& lane : adaptive.of_point) clear(lane, count);
  for (Lane<float>& lane : adaptive.of_point_without) clear(lane, count);
}

// Leaves those vectors open of which some hit is undecided or shaded by samples; of all others it is known
// what further samples would say.
HWY_NOINLINE inline void close_decided(int count, AdaptiveLight& adaptive) {
  adaptive.open_count = 0;
  const VF zero = hn::Zero(kF);
  for (int slot = 0; slot < count; slot += kLanes) {
    const VF wanted = hn::Max(load(&adaptive.undecided[slot]), load(&adaptive.by_samples[slot]));
    if (hn::AllFalse(kF, hn::And(hn::Gt(wanted, zero), first_lanes(count - slot)))) continue;
    adaptive.open_slots[adaptive.open_count++] = static_cast<std::int16_t>(slot);
  }
}

// One light at hits [0, count) of a batch.
template <Lobe kLobe>
HWY_NOINLINE void adaptive_light(const TileJob& job, const LightRecord& light, const ShadingPoints& points,
                                 const HighlightUse& use, HitBatch& hits, int count, RayKind kind) {
  AdaptiveLight& adaptive = *job.scratch->adaptive;
  begin(count, adaptive);
  HighlightUse of_points;
  find_use<kLobe>(points.light, hits, count, of_points);
  find_by_samples<kLobe>(light, points, use, of_points, hits, count, adaptive);
  find_pairs(hits, count, adaptive);
  for (int s = 0; s < light.samples; ++s) {
    if (s < light.first_samples) {
      first_visibility(job, light, s, hits, count, kind);
    } else {
      if (s == light.first_samples) {
        decide(hits, count, adaptive);
        close_decided(count, adaptive);
      }
      predict(job, light, s);
      later_visibility(job, light, s, hits, kind);
    }
    note_seen(job, light, points.of_sample[static_cast<std::size_t>(s)], s, hits);
    shade_sample<kLobe>(job, light, s, use, hits);
  }
  shade_points<kLobe>(job, points, of_points, hits, count);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
