// Stage: shaded samples -> texels {s, r}: s = virtual light, r = share of the camera feed that is kept.
// Objects: r = 0. Misses: r = 1, s = 0. Catchers: r = E_with / E_without (differential rendering), s = what
// they mirror of the virtual objects.
#pragma once

#include <cstring>

#include "renderer/lighting/catcher_ratio-inl.h"
#include "renderer/lighting/refractions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Replaces what is not finite by 0 and counts it; keeps the rest within the range of half.
HWY_INLINE VF finite_half(VF value, MF lanes, std::int64_t& nonfinite) {
  const MF finite = hn::Le(hn::Abs(value), set(3e38f));
  const MF bad = hn::AndNot(finite, lanes);
  if (!hn::AllFalse(kF, bad)) nonfinite += static_cast<std::int64_t>(hn::CountTrue(kF, bad));
  return hn::IfThenElseZero(finite, hn::Min(hn::Max(value, hn::Zero(kF)), set(kLargestHalf)));
}

// Paper, Figure 6: the background shows where samples come from, in tiles of 15 degrees.
HWY_INLINE V3 debug_colour(const RayGrid& grid, int x, int y) {
  alignas(64) float shade[kMaxLanes], hue[kMaxLanes];
  for (int lane = 0; lane < kLanes; ++lane) {
    const PolarSamples& samples = *grid.samples;
    const double theta = samples.map().theta_from_u((x + lane % 4 + 0.5) / samples.width());
    const double phi = 360.0 * (y + lane / 4 + 0.5) / samples.height();
    const int ring = static_cast<int>(theta / 15.0), sector = static_cast<int>(phi / 15.0);
    shade[lane] = (ring + sector) % 2 == 0 ? 0.55f : 0.18f;
    hue[lane] = static_cast<float>(ring % 4) / 4.0f;
  }
  const VF s = load(shade), h = load(hue), one = set(1.0f);
  return {hn::Mul(s, hn::Sub(one, h)), hn::Mul(s, hn::MulAdd(h, set(0.5f), set(0.35f))),
          hn::Mul(s, hn::MulAdd(h, set(0.7f), set(0.2f)))};
}

struct Texel {
  V3 light, ratio;
};

// With `behind` in place of the feed.
HWY_INLINE Texel painted_texel(const Texel& texel, const V3& behind) {
  const VF zero = hn::Zero(kF);
  return {
      {hn::MulAdd(behind.x, texel.ratio.x, texel.light.x), hn::MulAdd(behind.y, texel.ratio.y, texel.light.y),
       hn::MulAdd(behind.z, texel.ratio.z, texel.light.z)},
      {zero, zero, zero}};
}

// What the feed keeps on catchers, and what is added to it.
HWY_INLINE Texel catcher_texel(const TileJob& job, int slot, MF catcher) {
  const FramePlan& plan = *job.shading->plan;
  const CatcherLight at =
      catcher_light(*job.shading, job.scratch->first, slot, plan.occlusion, plan.catcher_mirrors);
  job.counters->light_beyond_feed +=
      static_cast<std::int64_t>(hn::CountTrue(kF, hn::And(at.beyond, catcher)));
  return {at.added, at.ratio};
}

// What the first hits themselves show and keep.
HWY_INLINE Texel surface_texel(const TileJob& job, int packet, VI kind) {
  const ShadingInputs& shading = *job.shading;
  const HitBatch& hits = job.scratch->first;
  const int slot = packet * kLanes;
  const auto is = [&](HitKind k)
                      HWY_ATTR { return hn::RebindMask(kF, hn::Eq(kind, hn::Set(kI, static_cast<int>(k)))); };
  const MF object = is(HitKind::object), catcher = is(HitKind::catcher);
  const VF zero = hn::Zero(kF), one = set(1.0f);
  Texel texel{{zero, zero, zero}, {one, one, one}};
  if (!hn::AllFalse(kF, object)) {
    texel.light =
        select(object, outgoing(hits, slot, shading, shading.plan->mirror_rays, shading.plan->occlusion),
               texel.light);
    texel.ratio = select(object, V3{zero, zero, zero}, texel.ratio);
  }
  if (shading.plan->catchers && !hn::AllFalse(kF, catcher)) {
    Texel real = catcher_texel(job, slot, catcher);
    if (shading.paints_catchers) real = painted_texel(real, set3(shading.see_through));
    texel.ratio = select(catcher, real.ratio, texel.ratio);
    texel.light = select(catcher, real.light, texel.light);
  }
  return texel;
}

// Puts the background behind: debug colours, one colour or the environment, where no feed is shown.
HWY_INLINE void put_background(const TileJob& job, int packet, Texel& texel) {
  const ShadingInputs& shading = *job.shading;
  const HitBatch& hits = job.scratch->first;
  const int slot = packet * kLanes;
  if (shading.debug_tiles && job.grid->polar) {
    const V3 colour = scale(debug_colour(*job.grid, job.scratch->packet_x[static_cast<std::size_t>(packet)],
                                         job.scratch->packet_y[static_cast<std::size_t>(packet)]),
                            set(shading.shown_white));
    texel = painted_texel(texel, colour);
  } else if (shading.paints_see_through) {
    texel = painted_texel(texel, set3(shading.see_through));
  } else if (shading.background_is_environment) {
    const V3 back = load3(hits.viewer, slot);
    texel = painted_texel(texel, environment_radiance(shading, scale(back, set(-1.0f))));
  }
}

// Copies one texel to its place and to those of the border that repeat it (foveation/radiance_buffer.h).
HWY_INLINE void place(const TexelSink& sink, std::uint16_t* plane, int x, int y, const std::uint16_t* texel) {
  const auto put = [&](int column, int row) {
    std::memcpy(plane + 4 * texel_index(sink.row_stride, column, row), texel, 4 * sizeof(std::uint16_t));
  };
  const int width = sink.width, height = sink.height;
  const auto put_rows = [&](int column, int row) {
    put(column, row);
    if (row == (sink.polar ? height - 1 : 0)) put(column, -1);
    for (int below = height; below < height + kBorderBelow; ++below) {
      if (row == (sink.polar ? below - height : height - 1)) put(column, below);
    }
  };
  const int across = y < height / 2 ? y + height / 2 : y - height / 2;
  for (int column = x; column <= (x == width - 1 ? width + 1 : x); ++column) {
    put_rows(column, y);
    if (sink.polar && column < 2) put_rows(-1 - column, across);
  }
  if (!sink.polar && x == 0) {
    put_rows(-1, y);
    put_rows(-2, y);
  }
}

HWY_INLINE void store_plane(const TexelSink& sink, std::uint16_t* plane, const V3& rgb, VF w, int x, int y,
                            VI kind) {
  const hn::Rebind<hwy::float16_t, F> half;
  const hn::RebindToUnsigned<decltype(half)> bits;
  alignas(64) std::uint16_t texels[4 * kMaxLanes];
  const auto to_half = [&](VF value) HWY_ATTR {
    return hn::BitCast(bits, hn::DemoteTo(half, half_rounded(kF, value)));
  };
  hn::StoreInterleaved4(to_half(rgb.x), to_half(rgb.y), to_half(rgb.z), to_half(w), bits, texels);
  constexpr int kRows = kLanes / 4;
  const bool repeated = x == 0 || y < 2 || x + 4 >= sink.width || y + kRows >= sink.height;
  if (!repeated && hn::AllTrue(kI, hn::Ne(kind, hn::Set(kI, static_cast<int>(HitKind::none))))) {
    // Rows of four texels at once: stores wait for the cache, so few of them.
    for (int row = 0; row < kRows; ++row) {
      const std::size_t first = texel_index(sink.row_stride, x, y + row);
      std::memcpy(plane + 4 * first, texels + 16 * row, 16 * sizeof(std::uint16_t));
    }
    return;
  }
  alignas(64) std::int32_t kinds[kMaxLanes];
  hn::Store(kind, kI, kinds);
  for (int lane = 0; lane < kLanes; ++lane) {
    if (kinds[lane] == static_cast<int>(HitKind::none)) continue;
    place(sink, plane, x + lane % 4, y + lane / 4, texels + 4 * lane);
  }
}

// A texel as it is stored, but for rounding: with its background, and finite.
HWY_INLINE Texel finished_texel(const TileJob& job, int packet, VI kind, Texel texel) {
  std::int64_t& nonfinite = job.counters->nonfinite_values;
  const MF lanes = hn::RebindMask(kF, hn::Ne(kind, hn::Zero(kI)));
  put_background(job, packet, texel);
  texel.light = {finite_half(texel.light.x, lanes, nonfinite), finite_half(texel.light.y, lanes, nonfinite),
                 finite_half(texel.light.z, lanes, nonfinite)};
  texel.ratio = {finite_half(texel.ratio.x, lanes, nonfinite), finite_half(texel.ratio.y, lanes, nonfinite),
                 finite_half(texel.ratio.z, lanes, nonfinite)};
  return texel;
}

// Stores the texels of a packet whose first sample is (x, y).
HWY_INLINE void store_texels(const TexelSink& sink, int x, int y, VI kind, const Texel& texel) {
  store_plane(sink, sink.texels, texel.light, texel.ratio.y, x, y, kind);
  if (sink.ratios) store_plane(sink, sink.ratios, texel.ratio, hn::Zero(kF), x, y, kind);
}

// What the samples of a packet hit first, and their texels once they are lit: of all layers where they blend.
struct ResolvedPacket {
  VI kind;
  Texel texel;
};

HWY_NOINLINE inline void resolve_packet(const TileJob& job, int packet, ResolvedPacket& out) {
  const int slot = packet * kLanes;
  if (job.shading->plan->alpha_blend) {
    const AlphaLayers& layers = *job.scratch->layers;
    out.kind = hn::Load(kI, &layers.kind[slot]);
    out.texel = {load3(layers.light, slot), load3(layers.ratio, slot)};
  } else {
    out.kind = hn::Load(kI, &job.scratch->first.kind[slot]);
    out.texel = surface_texel(job, packet, out.kind);
  }
  out.texel = finished_texel(job, packet, out.kind, out.texel);
}

HWY_NOINLINE inline void resolve(const TileJob& job, int packets) {
  const TileScratch& scratch = *job.scratch;
  for (int packet = 0; packet < packets; ++packet) {
    const auto p = static_cast<std::size_t>(packet);
    ResolvedPacket at;
    resolve_packet(job, packet, at);
    store_texels(job.grid->sink, scratch.packet_x[p], scratch.packet_y[p], at.kind, at.texel);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
