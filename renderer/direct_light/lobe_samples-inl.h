// Highlights that are narrower than the strata of a light, by directions drawn from their lobes. Of each few
// directions one has a shadow ray, chosen by what it would bring (Talbot et al., "Importance Resampling for
// Global Illumination", 2005): where nothing is in the way, or all of it, rays add no noise. The one ray
// stands for the colours of all: near grazing, where Fresnel's differ, a shadow's edge takes their mean.
// Before: light_samples brought the strata's share. After: direct light is complete.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/direct_light/light_samples-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Places in a lobe that one ray stands for: neighbours in azimuth, so that a shadow's edge across the lobe
// divides few groups. Hammersley's points, moved by three random numbers of each hit.
struct DrawnPlace {
  float cosine, sine, u, along;  // azimuth; out of [0, 1); which part of the chord
};
constexpr int kMostEach = 32;
using DrawnPlaces = std::array<DrawnPlace, kMostEach>;

HWY_INLINE float mirrored_bits(std::uint32_t i) {
  std::uint32_t mirrored = 0;
  for (int bit = 0; bit < 24; ++bit, i >>= 1) mirrored = mirrored << 1 | (i & 1);
  return static_cast<float>(mirrored) * 0x1p-24f;
}

HWY_INLINE DrawnPlaces drawn_places(const LobeCounts& counts, int ray) {
  constexpr double kTwoPi = 6.283185307179586, kGolden = 0.6180339887498949;
  DrawnPlaces places;
  for (int k = 0; k < counts.each; ++k) {
    const int i = ray * counts.each + k;
    const double azimuth = kTwoPi * i / counts.all(), along = kGolden * i;
    places[static_cast<std::size_t>(k)] = {
        static_cast<float>(std::cos(azimuth)), static_cast<float>(std::sin(azimuth)),
        mirrored_bits(static_cast<std::uint32_t>(i)), static_cast<float>(along - std::floor(along))};
  }
  return places;
}

// What the directions of one ray bring together, per unit of intensity, and the way to the place of the light
// that was chosen.
struct DrawnLight {
  V3 brings, to_light;
  MF lanes;  // where they bring anything
};

HWY_INLINE VF moved(float place, VF by) {
  const VF sum = hn::Add(set(place), by);
  return hn::Sub(sum, hn::Floor(sum));
}

// The highlight per unit of irradiance from a direction.
template <Lobe kLobe>
HWY_INLINE V3 highlight(const HitBatch& hits, int slot, Highlight which, const LobeAngles& at, const V3& n,
                        const V3& direction) {
  const VF zero = hn::Zero(kF);
  if constexpr (kLobe == Lobe::layered) {
    if (which == Highlight::coat) {
      const VF shine = coat_lit(hits, slot, at, direction, zero);
      return {shine, shine, shine};
    }
  }
  const VF common = base_lit<kLobe>(hits, slot, at, n, direction, zero);
  return scale(base_colour<kLobe>(hits, slot, at.l_h), common);
}

// Random numbers `numbers` and on of the light belong to this highlight.
template <Lobe kLobe>
HWY_INLINE DrawnLight draw_light(const LightRecord& light, const LightBox& box, const LobeCounts& counts,
                                 const DrawnPlaces& places, int ray, const HitBatch& hits, int slot,
                                 Highlight which, std::uint32_t numbers) {
  constexpr float kTwoPi = 6.28318531f;
  const VF zero = hn::Zero(kF);
  const V3 n = load3(hits.normal, slot), g = load3(hits.geometric_normal, slot);
  const V3 v = load3(hits.viewer, slot), p = load3(hits.position, slot);
  const DrawnLobe lobe = drawn_lobe<kLobe>(hits, slot, which);
  const VU key = hn::Load(kU, &hits.key[slot]);
  const VF turn = hn::Mul(set(kTwoPi), unit_float(hash(key, numbers)));
  const VF cosine = hn::Cos(kF, turn), sine = hn::Sin(kF, turn);
  const VF by_u = unit_float(hash(key, numbers + 1)), by_along = unit_float(hash(key, numbers + 2));
  DrawnLight out{{zero, zero, zero}, {zero, zero, zero}, first_lanes(0)};
  VF sum = zero;
  for (int k = 0; k < counts.each; ++k) {
    const DrawnPlace& place = places[static_cast<std::size_t>(k)];
    const VF c = hn::MulSub(cosine, set(place.cosine), hn::Mul(sine, set(place.sine)));
    const VF s = hn::MulAdd(sine, set(place.cosine), hn::Mul(cosine, set(place.sine)));
    const DrawnDirection drawn = draw(lobe, v, c, s, moved(place.u, by_u));
    const Chord chord = chord_through(box, p, drawn.direction);
    const VF n_l = dot(n, drawn.direction);
    const VF least = hn::Min(chord.length, hn::Min(n_l, dot(g, drawn.direction)));
    const MF meets = hn::Gt(least, zero);
    if (hn::AllFalse(kF, meets)) continue;
    const VF place_along = hn::MulAdd(moved(place.along, by_along), chord.length, chord.begin);
    const VF t = within_light(light, box, chord, p, drawn.direction, place_along), t2 = hn::Mul(t, t);
    const VF radiance = hn::Mul(hn::Mul(hn::Mul(chord.length, t2), falloff(light, t2, drawn.direction)),
                                set(1.0f / box.volume));
    const VF density = hn::MulAdd(set(static_cast<float>(counts.all())), density_of(lobe, drawn.h),
                                  density_of_strata(light, box, chord));
    const LobeAngles at = lobe_angles(n, v, drawn.direction, hn::Max(n_l, zero));
    const VF weight = hn::Div(hn::Mul(at.n_l, radiance), hn::Max(density, set(1e-30f)));
    const V3 brings = only(meets, scale(highlight<kLobe>(hits, slot, which, at, n, drawn.direction), weight));
    const VF bright = hn::Add(brings.x, hn::Add(brings.y, brings.z));
    out.brings = add(out.brings, brings);
    sum = hn::Add(sum, bright);
    const auto number = numbers + 3 + static_cast<std::uint32_t>(ray * counts.each + k);
    const MF chosen = hn::Lt(hn::Mul(unit_float(hash(key, number)), sum), bright);
    out.to_light = select(chosen, scale(drawn.direction, t), out.to_light);
  }
  out.lanes = hn::Gt(sum, zero);
  return out;
}

// Adds what directions drawn from one highlight bring of a light.
template <Lobe kLobe>
HWY_NOINLINE void add_highlight(const TileJob& job, const LightRecord& light, const Lane<std::int32_t>& use,
                                HitBatch& hits, int count, RayKind kind, Highlight which) {
  constexpr std::uint32_t kNumbers = 1u << 16;  // beyond those of the strata
  const std::uint32_t own = which == Highlight::coat ? 1 : 0;
  const std::uint32_t numbers = light.key + kNumbers + own * 2 * kMostLightSamples;
  RayQueue& queue = job.scratch->queue;
  alignas(64) Lane<float> passes, red, green, blue;
  const LightBox box = box_of(light);
  const LobeCounts counts = lobe_counts(light);
  for (int ray = 0; ray < counts.rays; ++ray) {
    begin_light_rays(queue, light, kMostLightSamples + 2 * ray + static_cast<int>(own));
    const DrawnPlaces places = drawn_places(counts, ray);
    for (int slot = 0; slot < count; slot += kLanes) {
      const MF shared = used_as(use, slot, kShared);
      if (hn::AllFalse(kF, shared)) continue;
      const DrawnLight of = draw_light<kLobe>(light, box, counts, places, ray, hits, slot, which, numbers);
      const MF lanes = hn::And(shared, of.lanes);
      hn::StoreU(hn::Compress(of.brings.x, lanes), kF, red.data() + queue.count);
      hn::StoreU(hn::Compress(of.brings.y, lanes), kF, green.data() + queue.count);
      hn::StoreU(hn::Compress(of.brings.z, lanes), kF, blue.data() + queue.count);
      push_shadow_rays(queue, hits, slot, of.to_light, lanes);
    }
    std::fill_n(passes.begin(), queue.count, 1.0f);
    trace_occlusion(job, hits, queue, kAllMask, kind,
                    [&](int i, float share) { passes[static_cast<std::size_t>(i)] = share; });
    for (std::size_t i = 0; i < static_cast<std::size_t>(queue.count); ++i) {
      const auto hit = static_cast<std::size_t>(queue.hit[i]);
      hits.direct.x[hit] += light.intensity[0] * passes[i] * red[i];
      hits.direct.y[hit] += light.intensity[1] * passes[i] * green[i];
      hits.direct.z[hit] += light.intensity[2] * passes[i] * blue[i];
    }
  }
}

// Narrow highlights of a light at hits [0, count), whose samples were added.
template <Lobe kLobe>
HWY_INLINE void add_highlights(const TileJob& job, const LightRecord& light, const HighlightUse& use,
                               HitBatch& hits, int count, RayKind kind) {
  if constexpr (kLobe != Lobe::none) {
    if (use.shares_base) add_highlight<kLobe>(job, light, use.base, hits, count, kind, Highlight::base);
  }
  if constexpr (kLobe == Lobe::layered) {
    if (use.shares_coat) add_highlight<kLobe>(job, light, use.coat, hits, count, kind, Highlight::coat);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
