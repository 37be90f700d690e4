// Stage: light rays. Direct light of every light at the hits of a batch: N
// stratified samples per light, E = (I / N) sum V cos(theta) / max(d^2, r^2),
// diffuse and specular. With adaptive samples a few strata are traced for every
// hit, and the rest only where they disagree (after Heckbert & Herf 1997 and
// Mitchell 1987: refine where the first samples differ).
#if defined(HERR_DIRECT_LIGHT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HERR_DIRECT_LIGHT_INL
#undef HERR_DIRECT_LIGHT_INL
#else
#define HERR_DIRECT_LIGHT_INL
#endif

#include <cstring>

#include "renderer/lighting/reflectance-inl.h"
#include "renderer/lighting/shadow_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

HWY_INLINE void add_to(Lane<float>& lane, int slot, VF value) {
  hn::Store(hn::Add(load(&lane[slot]), value), kF, &lane[slot]);
}

HWY_INLINE void clear(Lane<float>& lane, int count) {
  std::memset(lane.data(), 0,
              sizeof(float) * static_cast<std::size_t>((count + kLanes - 1) / kLanes * kLanes));
}

// Irradiance per unit of intensity and cosine: 1 / max(d^2, r^2), times a
// spot's cone and the end of its range (KHR_lights_punctual). `direction` is
// towards the light, unit. A sun is equally bright everywhere.
HWY_INLINE VF falloff(const LightRecord& light, VF distance2, const V3& direction) {
  const VF zero = hn::Zero(kF), one = set(1.0f);
  if (light.kind == LightKind::sun) return one;
  VF value = hn::Div(one, hn::Max(distance2, set(light.min_distance2)));
  if (light.kind == LightKind::spot) {
    const VF cosine = hn::Neg(dot(set3(light.direction), direction));
    const VF cone =
        hn::Min(hn::Max(hn::MulAdd(cosine, set(light.cone_scale), set(light.cone_offset)), zero), one);
    value = hn::Mul(value, hn::Mul(cone, cone));
  }
  if (light.inverse_range2 > 0) {
    const VF share = hn::Mul(distance2, set(light.inverse_range2));
    value = hn::Mul(value, hn::Max(hn::NegMulAdd(share, share, one), zero));
  }
  return value;
}

// Adds one light sample, with the visibility found by tracing.
template <bool kSpecular>
HWY_INLINE void add_sample(const TileJob& job, const LightRecord& light, int s, HitBatch& hits, int slot) {
  const TileScratch& scratch = *job.scratch;
  const V3 to_light = way_to_light(light, s, hits, slot);
  const VF visible = load(&scratch.visible[slot]);
  const VF counts =
      job.shading->plan->catchers ? hn::Max(visible, load(&scratch.visible_without[slot])) : visible;
  const MF lit = hn::And(facing(hits, slot, to_light), hn::Gt(counts, hn::Zero(kF)));
  if (hn::AllFalse(kF, lit)) return;
  const VF distance2 = hn::Max(dot(to_light, to_light), set(1e-20f));
  const V3 direction = scale(to_light, hn::Div(set(1.0f), hn::Sqrt(distance2)));
  const V3 n = load3(&hits.nx[slot], &hits.ny[slot], &hits.nz[slot]);
  const VF n_l = hn::Max(dot(n, direction), hn::Zero(kF));
  const VF share =
      hn::Mul(set(1.0f / static_cast<float>(light.samples)), falloff(light, distance2, direction));
  const VF geometry = hn::IfThenElseZero(lit, hn::Mul(n_l, share));
  const VF seen = hn::Mul(geometry, visible);
  V3 f = reflectance<kSpecular>(hits, slot, n, direction, n_l);
  if (job.shading->plan->catchers) {
    // On a catcher the sum is irradiance itself, twice: with the virtual
    // objects and without.
    const MF catcher = of_kind(hits, slot, HitKind::catcher);
    if (!hn::AllFalse(kF, catcher)) {
      const VF one = set(1.0f);
      f = select(catcher, V3{one, one, one}, f);
      const VF alone = hn::Mul(geometry, load(&scratch.visible_without[slot]));
      add_to(hits.wr, slot, hn::Mul(alone, set(light.intensity[0])));
      add_to(hits.wg, slot, hn::Mul(alone, set(light.intensity[1])));
      add_to(hits.wb, slot, hn::Mul(alone, set(light.intensity[2])));
    }
  }
  add_to(hits.lr, slot, hn::Mul(hn::Mul(seen, set(light.intensity[0])), f.x));
  add_to(hits.lg, slot, hn::Mul(hn::Mul(seen, set(light.intensity[1])), f.y));
  add_to(hits.lb, slot, hn::Mul(hn::Mul(seen, set(light.intensity[2])), f.z));
}

// Queues one shadow ray for each hit that faces sample `s`, or for the
// undecided of them, and fills in what is known without one: visible, or what
// the first strata agreed on.
template <bool kUndecidedOnly>
HWY_INLINE void queue_shadow_rays(const TileJob& job, const LightRecord& light, int s, const HitBatch& hits,
                                  int count) {
  TileScratch& scratch = *job.scratch;
  const AdaptiveLight& adaptive = scratch.adaptive;
  scratch.queue.count = 0;
  const VI lane = hn::Iota(kI, 0);
  for (int slot = 0; slot < count; slot += kLanes) {
    const V3 to_light = way_to_light(light, s, hits, slot);
    MF lit = facing(hits, slot, to_light);
    VF known = set(1.0f), known_without = known;
    if constexpr (kUndecidedOnly) {
      const MF undecided = hn::Ne(load(&adaptive.undecided[slot]), hn::Zero(kF));
      known = hn::IfThenElse(undecided, known, load(&adaptive.agreed[slot]));
      known_without = hn::IfThenElse(undecided, known, load(&adaptive.agreed_without[slot]));
      lit = hn::And(lit, undecided);
    }
    hn::Store(known, kF, &scratch.visible[slot]);
    hn::Store(known_without, kF, &scratch.visible_without[slot]);
    if (hn::AllFalse(kF, lit)) continue;
    // From the ray's origin to the same point.
    const V3 g = load3(&hits.gx[slot], &hits.gy[slot], &hits.gz[slot]);
    const V3 direction = mul_add(hn::Neg(load(&hits.offset[slot])), g, to_light);
    push(scratch.queue, ray_origin(hits, slot), direction, hn::Add(lane, hn::Set(kI, slot)), lit);
  }
}

HWY_INLINE void find_visibility(const TileJob& job, const HitBatch& hits, RayKind kind) {
  TileScratch& scratch = *job.scratch;
  trace_visibility(
      job, hits, kind, RayKind::catcher_shadow, [&](std::size_t hit) { scratch.visible[hit] = 0.0f; },
      [&](std::size_t hit) { scratch.visible_without[hit] = 0.0f; });
}

// Adds up how many of the samples traced so far a hit faces and sees.
HWY_INLINE void count_seen(const TileJob& job, const LightRecord& light, int s, const HitBatch& hits,
                           int slot) {
  TileScratch& scratch = *job.scratch;
  const MF lit = facing(hits, slot, way_to_light(light, s, hits, slot));
  add_to(scratch.adaptive.faced, slot, hn::IfThenElseZero(lit, set(1.0f)));
  add_to(scratch.adaptive.seen, slot, hn::IfThenElseZero(lit, load(&scratch.visible[slot])));
  add_to(scratch.adaptive.seen_without, slot, hn::IfThenElseZero(lit, load(&scratch.visible_without[slot])));
}

// Decides for each hit, from the strata traced so far, whether it sees all of
// the light, nothing of it, or must ask the other strata too: where its own
// strata or those of hits in its 4x4 block or the four blocks around disagree.
// Blocks are the same on every instruction set, and so is the decision.
HWY_INLINE void decide(const HitBatch& hits, int count, AdaptiveLight& adaptive) {
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
  std::array<bool, kBlocksInTile> mixed{};
  for (int y = 0; y < kBlocksAlong; ++y) {
    for (int x = 0; x < kBlocksAlong; ++x) {
      std::uint8_t around = 0, around_without = 0;
      const auto look = [&](int bx, int by) {
        if (bx < 0 || by < 0 || bx >= kBlocksAlong || by >= kBlocksAlong) return;
        const auto b = static_cast<std::size_t>(by * kBlocksAlong + bx);
        around |= with[b], around_without |= without[b];
      };
      look(x, y), look(x - 1, y), look(x + 1, y), look(x, y - 1), look(x, y + 1);
      mixed[static_cast<std::size_t>(y * kBlocksAlong + x)] = around == kMixed || around_without == kMixed;
    }
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    adaptive.undecided[i] = mixed[hits.block[i]] ? 1.0f : 0.0f;
    adaptive.agreed[i] = adaptive.seen[i] > 0 ? 1.0f : 0.0f;
    adaptive.agreed_without[i] = adaptive.seen_without[i] > 0 ? 1.0f : 0.0f;
  }
}

// One light at hits [0, count) of a batch.
template <bool kSpecular>
HWY_INLINE void light_up(const TileJob& job, const LightRecord& light, HitBatch& hits, int count,
                         RayKind kind) {
  const int first = job.shading->first_light_samples;
  if (first == 0 || light.samples <= first) {
    for (int s = 0; s < light.samples; ++s) {
      queue_shadow_rays<false>(job, light, s, hits, count);
      find_visibility(job, hits, kind);
      for (int slot = 0; slot < count; slot += kLanes) add_sample<kSpecular>(job, light, s, hits, slot);
    }
    return;
  }
  AdaptiveLight& adaptive = job.scratch->adaptive;
  for (Lane<float>* lane : {&adaptive.faced, &adaptive.seen, &adaptive.seen_without}) clear(*lane, count);
  for (int s = 0; s < first; ++s) {
    queue_shadow_rays<false>(job, light, s, hits, count);
    find_visibility(job, hits, kind);
    for (int slot = 0; slot < count; slot += kLanes) {
      count_seen(job, light, s, hits, slot);
      add_sample<kSpecular>(job, light, s, hits, slot);
    }
  }
  decide(hits, count, adaptive);
  for (int s = first; s < light.samples; ++s) {
    queue_shadow_rays<true>(job, light, s, hits, count);
    find_visibility(job, hits, kind);
    for (int slot = 0; slot < count; slot += kLanes) add_sample<kSpecular>(job, light, s, hits, slot);
  }
}

// Direct light of every light at hits [0, count) of a batch.
template <bool kSpecular>
void direct_light(const TileJob& job, HitBatch& hits, int count, RayKind kind) {
  for (Lane<float>* lane : {&hits.lr, &hits.lg, &hits.lb}) clear(*lane, count);
  if (job.shading->plan->catchers) {
    for (Lane<float>* lane : {&hits.wr, &hits.wg, &hits.wb}) clear(*lane, count);
  }
  for (const LightRecord& light : job.shading->lights) light_up<kSpecular>(job, light, hits, count, kind);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();

#endif
