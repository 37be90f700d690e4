// Stage: indirect light. The eight probes around a hit, weighed by distance (trilinear), by side (none from
// behind the surface) and by sight (Chebyshev's inequality on the probe's distance map, after Majercik et al.
// 2019), give the mean radiance that the surface receives from everything but the lights themselves.
#pragma once

#include <bit>

#include "renderer/direct_light/shadow_rays-inl.h"
#include "renderer/environment/environment-inl.h"
#include "renderer/probes/probe_view.h"
#include "renderer/simd/simd_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Probes that do not see a place count this little of what they would: nothing beside any that does, and
// everything in a recess that none of them sees.
constexpr float kLeastSight = 1e-7f;
// Less than all weights of such probes together: nothing at all is known.
constexpr float kSmallestKnowledge = 1e-10f;
// A probe counts in full from 1/8 = 7 degrees above the surface's plane, and not at all from behind it.
constexpr float kSideSlope = 8.0f;
// Of a probe's tolerance: a thousandth of the smallest spacing.
constexpr float kBeforeSurface = 0.1f;
// Sight below this falls off as its cube: walls must hold better than Chebyshev's bound.
constexpr float kPoorSight = 0.2f;

// No way is shorter, nor its square, however small the scene: keeps inverses finite.
constexpr float kShortest = 1e-24f;

// Three nodes of an octahedral map around a direction, and their weights, which sum to 1.
struct MapTaps {
  VI node[3];
  VF weight[3];
};

template <int N>
HWY_INLINE MapTaps map_taps(const V3& d, VF inverse_norm) {
  const VF one = set(1.0f);
  const VF px = hn::Abs(hn::Mul(d.x, inverse_norm)), py = hn::Abs(hn::Mul(d.y, inverse_norm));
  const MF lower_half = hn::Lt(d.z, hn::Zero(kF));
  const VF half = set(0.5f * N);
  const VF a = hn::Mul(hn::Max(hn::IfThenElse(lower_half, hn::Sub(one, py), px), hn::Zero(kF)), half);
  const VF b = hn::Mul(hn::Max(hn::IfThenElse(lower_half, hn::Sub(one, px), py), hn::Zero(kF)), half);
  const VF last = set(0.5f * N - 1.0f);
  const VF i = hn::Min(hn::Floor(a), last), j = hn::Min(hn::Floor(b), last);
  const VF fx = hn::Min(hn::Sub(a, i), one), fy = hn::Min(hn::Sub(b, j), one);
  // Away from the middle along both axes; the map is symmetric, so everything is done in one quadrant.
  const auto away = [&](VF x, int step) HWY_ATTR {
    return hn::IfThenElse(hn::RebindMask(kI, hn::Lt(x, hn::Zero(kF))), hn::Set(kI, -step), hn::Set(kI, step));
  };
  const VI step_x = away(d.x, 1), step_y = away(d.y, OctahedralNodes<N>::kStride);
  const VI middle = hn::Set(kI, OctahedralNodes<N>::at(N / 2, N / 2));
  const VI corner =
      hn::Add(middle, hn::Add(hn::Mul(step_x, hn::ConvertTo(kI, i)), hn::Mul(step_y, hn::ConvertTo(kI, j))));
  const VI along_x = hn::Add(corner, step_x), along_y = hn::Add(corner, step_y);
  const VF outer = hn::Sub(hn::Add(fx, fy), one);
  const MF beyond = hn::Gt(outer, hn::Zero(kF));  // the triangle away from the middle
  MapTaps taps;
  taps.node[0] = hn::IfThenElse(hn::RebindMask(kI, beyond), hn::Add(along_x, step_y), corner);
  taps.node[1] = along_x;
  taps.node[2] = along_y;
  taps.weight[0] = hn::Abs(outer);
  taps.weight[1] = hn::IfThenElse(beyond, hn::Sub(one, fy), fx);
  taps.weight[2] = hn::IfThenElse(beyond, hn::Sub(one, fx), fy);
  return taps;
}

HWY_INLINE VF norm_of(const V3& d) {
  return hn::Max(hn::Add(hn::Abs(d.x), hn::Add(hn::Abs(d.y), hn::Abs(d.z))), set(kShortest));
}

// The first lane of `some` in every lane. Hits of a packet mostly share their cell, and on flat surfaces the
// normal: what they then read is one value for all lanes.
HWY_INLINE VI first_of(VI value, MF some) {
  alignas(64) std::int32_t lanes[kMaxLanes];
  hn::Store(value, kI, lanes);
  return hn::Set(kI, lanes[hn::FindFirstTrue(kF, some)]);
}
HWY_INLINE bool all_same(VI value, VI first, MF some) {
  return hn::AllFalse(kF, hn::And(some, hn::RebindMask(kF, hn::Ne(value, first))));
}

// Words `word` and the one after it of each lane. Gathers take their time by the element, so pairs are taken
// as one of 64 bits.
struct WordPair {
  VU first, second;
};
HWY_INLINE WordPair gather_pair(const std::uint32_t* words, VI pair) {
  const hn::Repartition<std::uint64_t, U> wide;
  const hn::Repartition<std::int64_t, I> wide_index;
  const auto* pairs = reinterpret_cast<const std::uint64_t*>(words);
  const hn::Half<I> half;
  const auto lower = hn::GatherIndex(wide, pairs, hn::PromoteTo(wide_index, hn::LowerHalf(half, pair)));
  const auto upper = hn::GatherIndex(wide, pairs, hn::PromoteTo(wide_index, hn::UpperHalf(half, pair)));
  const VU low = hn::BitCast(kU, lower), high = hn::BitCast(kU, upper);
  return {hn::ConcatEven(kU, high, low), hn::ConcatOdd(kU, high, low)};
}

// Radiance of one probe towards `taps`, from its packed words; `one`: all lanes ask for the same.
HWY_INLINE V3 probe_light(const ProbeView& view, VI probe, const MapTaps& taps, bool one) {
  const VI first = hn::Mul(probe, hn::Set(kI, LightNodes::kCount));
  V3 sum{hn::Zero(kF), hn::Zero(kF), hn::Zero(kF)};
  if (one) {
    for (int tap = 0; tap < 3; ++tap) {
      const auto pair = static_cast<std::size_t>(hn::GetLane(first) + hn::GetLane(taps.node[tap]));
      const std::uint32_t* at = view.light + kLightWords * pair;
      const std::uint32_t b = (at[0] & 0x7ffu) << 20 | (at[1] & 0x3ffu) << 10;
      const V3 light{set(std::bit_cast<float>(at[0] >> 1 & 0x7ffffc00u)),
                     set(std::bit_cast<float>(at[1] >> 1 & 0x7ffffc00u)), set(std::bit_cast<float>(b))};
      sum = mul_add(taps.weight[tap], light, sum);
    }
    return sum;
  }
  const VU upper = hn::Set(kU, 0x7ffffc00u);
  for (int tap = 0; tap < 3; ++tap) {
    const WordPair words = gather_pair(view.light, hn::Add(first, taps.node[tap]));
    const VU b = hn::Or(hn::ShiftLeft<20>(hn::And(words.first, hn::Set(kU, 0x7ffu))),
                        hn::ShiftLeft<10>(hn::And(words.second, hn::Set(kU, 0x3ffu))));
    const V3 light{hn::BitCast(kF, hn::And(hn::ShiftRight<1>(words.first), upper)),
                   hn::BitCast(kF, hn::And(hn::ShiftRight<1>(words.second), upper)), hn::BitCast(kF, b)};
    sum = mul_add(taps.weight[tap], light, sum);
  }
  return sum;
}

// Where a probe's distance map is asked about a point. `one`: all lanes ask the same nodes.
struct SightLine {
  VF inverse_norm;
  MapTaps taps;
  bool one;
};
HWY_INLINE SightLine sight_line(VI probe, const V3& from_probe, bool one_probe) {
  SightLine line;
  line.inverse_norm = hn::Div(set(1.0f), norm_of(from_probe));
  line.taps = map_taps<kDistanceNodes>(from_probe, line.inverse_norm);
  const VI first = hn::Mul(probe, hn::Set(kI, DistanceNodes::kCount));
  for (VI& node : line.taps.node) node = hn::Add(first, node);
  const auto differs = [](VI node) HWY_ATTR { return hn::Ne(node, hn::Set(kI, hn::GetLane(node))); };
  const VI* node = line.taps.node;
  line.one =
      one_probe && hn::AllFalse(kI, hn::Or(differs(node[0]), hn::Or(differs(node[1]), differs(node[2]))));
  return line;
}

// How far a probe sees the point at the end of `line`: 1 in sight, towards 0 behind what it sees.
HWY_INLINE VF probe_sight(const ProbeView& view, const SightLine& line) {
  VF seen = hn::Zero(kF), deviation = hn::Zero(kF);
  for (int tap = 0; tap < 3; ++tap) {
    VF inverse, spread;
    if (line.one) {
      const std::uint32_t word = view.distances[hn::GetLane(line.taps.node[tap])];
      inverse = set(static_cast<float>(word & 0xffffu));
      spread = set(static_cast<float>(word >> 16));
    } else {
      const VU word = hn::GatherIndex(kU, view.distances, line.taps.node[tap]);
      inverse = hn::ConvertTo(kF, hn::BitCast(kI, hn::And(word, hn::Set(kU, 0xffffu))));
      spread = hn::ConvertTo(kF, hn::BitCast(kI, hn::ShiftRight<16>(word)));
    }
    seen = hn::MulAdd(line.taps.weight[tap], inverse, seen);
    deviation = hn::MulAdd(line.taps.weight[tap], spread, deviation);
  }
  // Inverse distances, so what lies behind is smaller. A tolerance ds of distance is ds / s^2 of its inverse.
  const float steps = kDistanceSteps * view.nearest;
  const VF behind = hn::Max(hn::NegMulAdd(line.inverse_norm, set(steps), seen), hn::Zero(kF));
  const VF tolerance =
      hn::MulAdd(hn::Mul(seen, seen), set(view.tolerance_m / steps), hn::Add(deviation, set(0.5f)));
  const VF variance = hn::Mul(tolerance, tolerance);
  const VF bound = hn::Div(variance, hn::MulAdd(behind, behind, variance));
  const VF sight = hn::Mul(bound, hn::Mul(bound, bound));
  const VF share = hn::Mul(sight, set(1.0f / kPoorSight));
  const VF poor = hn::Max(hn::Mul(sight, hn::Mul(share, share)), set(kLeastSight));
  return hn::IfThenElse(hn::Lt(sight, set(kPoorSight)), poor, sight);
}

// Cell of each point: index of its lowest probe and place within the cell, [0, 1] per axis. `faces_out`: the
// point lies beyond the outermost probes and its normal leads away from them.
struct ProbeCell {
  VI first;
  V3 place;
  MF faces_out;
};
HWY_INLINE ProbeCell probe_cell(const ProbeView& view, const V3& point, const V3& normal) {
  ProbeCell cell{hn::Zero(kI), {hn::Zero(kF), hn::Zero(kF), hn::Zero(kF)}, first_lanes(0)};
  const auto axis = [&](VF x, VF n, int a, int stride, VF& place) HWY_ATTR {
    const VF zero = hn::Zero(kF), last = set(static_cast<float>(view.counts[a] - 1));
    const VF g = hn::MulSub(x, set(view.inverse_spacing[a]), set(0.5f));
    cell.faces_out = hn::Or(cell.faces_out, hn::Or(hn::And(hn::Lt(g, zero), hn::Lt(n, zero)),
                                                   hn::And(hn::Gt(g, last), hn::Gt(n, zero))));
    const VF inside = hn::Max(hn::Min(g, last), zero);
    const VF base =
        hn::Min(hn::Floor(inside), set(static_cast<float>(view.counts[a] > 1 ? view.counts[a] - 2 : 0)));
    place = hn::Sub(inside, base);
    cell.first = hn::Add(cell.first, hn::Mul(hn::ConvertTo(kI, base), hn::Set(kI, stride)));
  };
  axis(point.x, normal.x, 0, 1, cell.place.x);
  axis(point.y, normal.y, 1, view.counts[0], cell.place.y);
  axis(point.z, normal.z, 2, view.counts[0] * view.counts[1], cell.place.z);
  return cell;
}

// A hit as look-ups need it: relative to the grid, idle lanes like the first one in use.
struct LookupPoint {
  V3 point, seen_point, normal, side_normal;
  MF surface;
  ProbeCell cell;
  MapTaps light_taps;
  bool one_cell, one_normal;
};

HWY_INLINE LookupPoint lookup_point(const ProbeView& view, const HitBatch& hits, int slot, MF surface) {
  const auto lane = static_cast<std::size_t>(slot) + hn::FindFirstTrue(kF, surface);
  const auto at = [&](const Lane3& of) HWY_ATTR {
    return select(surface, load3(of, slot), V3{set(of.x[lane]), set(of.y[lane]), set(of.z[lane])});
  };
  LookupPoint out;
  out.surface = surface;
  out.point = sub(at(hits.position), set3(view.lower));
  out.normal = at(hits.normal);
  out.side_normal = at(hits.geometric_normal);
  out.seen_point = mul_add(set(view.normal_bias_m), out.side_normal,
                           mul_add(set(view.view_bias_m), at(hits.viewer), out.point));
  // On a surface between two cells, the one before it: rounding must not choose.
  out.cell = probe_cell(view, mul_add(set(kBeforeSurface * view.tolerance_m), out.side_normal, out.point),
                        out.side_normal);
  const VI first = first_of(out.cell.first, surface);
  out.one_cell = all_same(out.cell.first, first, surface);
  const V3& n = out.normal;
  const auto varies = [](VF x, float first_x) HWY_ATTR { return hn::Ne(x, set(first_x)); };
  out.one_normal =
      hn::AllFalse(kF, hn::Or(varies(n.x, hits.normal.x[lane]),
                              hn::Or(varies(n.y, hits.normal.y[lane]), varies(n.z, hits.normal.z[lane]))));
  out.light_taps = map_taps<kLightNodes>(n, hn::Div(set(1.0f), norm_of(n)));
  return out;
}

// Where a probe stands, and whether it can be used: 1 or 0.
struct ProbeStand {
  V3 place;
  VF usable;
};
HWY_INLINE ProbeStand probe_stand(const ProbeView& view, VI probe, bool one) {
  if (one) {
    const float* at = view.places + 4 * static_cast<std::size_t>(hn::GetLane(probe));
    return {set3(at), set(at[3])};
  }
  const VI at = hn::ShiftLeft<2>(probe);
  return {{hn::GatherIndex(kF, view.places, at), hn::GatherIndex(kF, view.places + 1, at),
           hn::GatherIndex(kF, view.places + 2, at)},
          hn::GatherIndex(kF, view.places + 3, at)};
}

// What a probe counts by its place alone: trilinear share, and how squarely it stands before the surface.
HWY_INLINE VF standing_weight(const LookupPoint& at, const ProbeStand& stand, int dx, int dy, int dz) {
  const VF one = set(1.0f), half = set(0.5f);
  const V3 to_probe = sub(stand.place, at.point);
  const VF inverse_length = hn::Div(one, hn::Sqrt(hn::Max(dot(to_probe, to_probe), set(kShortest))));
  const VF side = hn::Mul(hn::Mul(dot(to_probe, at.side_normal), inverse_length), set(kSideSlope));
  const VF facing = hn::MulAdd(hn::Mul(dot(to_probe, at.normal), inverse_length), half, half);
  const V3& place = at.cell.place;
  const VF trilinear =
      hn::Mul(dx ? place.x : hn::Sub(one, place.x),
              hn::Mul(dy ? place.y : hn::Sub(one, place.y), dz ? place.z : hn::Sub(one, place.z)));
  const VF weight =
      hn::Mul(trilinear, hn::Mul(hn::Mul(facing, facing), hn::Min(hn::Max(side, hn::Zero(kF)), one)));
  return hn::IfThenElseZero(at.surface, hn::Mul(weight, stand.usable));
}

// What probes know of an open sky, told at nodes alone, against what the sky sends to the surface between
// them: where they see all of it the difference is added whole, elsewhere the share of it that they see.
HWY_INLINE V3 between_nodes(const ShadingInputs& shading, const ProbeView& view, const LookupPoint& at,
                            const V3& known) {
  V3 told{hn::Zero(kF), hn::Zero(kF), hn::Zero(kF)};
  for (int tap = 0; tap < 3; ++tap) {
    const VI node = hn::ShiftLeft<2>(at.light_taps.node[tap]);
    const V3 sky{hn::GatherIndex(kF, view.sky, node), hn::GatherIndex(kF, view.sky + 1, node),
                 hn::GatherIndex(kF, view.sky + 2, node)};
    told = mul_add(at.light_taps.weight[tap], sky, told);
  }
  const V3 sent = environment_texel(shading.filtered.even, at.normal);
  const auto channel = [](VF light, VF of_nodes, VF whole) HWY_ATTR {
    const VF seen = hn::Min(hn::Div(light, hn::Max(of_nodes, set(1e-20f))), set(1.0f));
    return hn::Max(hn::MulAdd(seen, hn::Sub(whole, of_nodes), light), hn::Zero(kF));
  };
  return {channel(known.x, told.x, sent.x), channel(known.y, told.y, sent.y),
          channel(known.z, told.z, sent.z)};
}

// What one set of probes says about a point: a weighed sum, and the weights.
struct ProbeSum {
  V3 light;
  VF weights;

  // Mean radiance from all sides (irradiance / pi), without the lights' own. The environment answers where no
  // probe can and the surface faces out of the volume.
  HWY_INLINE V3 radiance(const ShadingInputs& shading, const ProbeView& view, const LookupPoint& at) const {
    const VF one = set(1.0f);
    const VF scale_up = hn::Div(one, hn::Max(weights, set(kSmallestKnowledge)));
    const VF unknown = hn::Max(hn::NegMulAdd(weights, set(1.0f / kSmallestKnowledge), one), hn::Zero(kF));
    const VF open = hn::IfThenElseZero(hn::And(at.surface, at.cell.faces_out), unknown);
    V3 known = scale(light, scale_up);
    if (view.sky != nullptr) known = between_nodes(shading, view, at, known);
    if (hn::AllFalse(kF, hn::Gt(open, hn::Zero(kF)))) return known;
    const V3 outside = shading.filtered.even.texels != nullptr
                           ? environment_texel(shading.filtered.even, at.normal)
                           : environment_radiance(shading, at.normal);
    return mul_add(open, outside, known);
  }
};

// Asks the eight probes around a point, in every set: their places are the same in all, what they see and
// have gathered is not.
template <int kSets>
HWY_INLINE void ask_probes(const ProbeView* const (&views)[kSets], const LookupPoint& at,
                           ProbeSum (&sums)[kSets]) {
  for (ProbeSum& sum : sums) sum = {{hn::Zero(kF), hn::Zero(kF), hn::Zero(kF)}, hn::Zero(kF)};
  const ProbeView& view = *views[0];
  const VI first = at.one_cell ? first_of(at.cell.first, at.surface) : at.cell.first;
  for (int corner = 0; corner < 8; ++corner) {
    const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
    // On an axis of one probe the second corner has no weight; any index will do.
    const int step = (view.counts[0] > 1 ? dx : 0) + (view.counts[1] > 1 ? dy * view.counts[0] : 0) +
                     (view.counts[2] > 1 ? dz * view.counts[0] * view.counts[1] : 0);
    const VI probe = hn::Add(first, hn::Set(kI, step));
    const ProbeStand stand = probe_stand(view, probe, at.one_cell);
    const VF standing = standing_weight(at, stand, dx, dy, dz);
    if (hn::AllFalse(kF, hn::Gt(standing, hn::Zero(kF)))) continue;
    const SightLine line = sight_line(probe, sub(at.seen_point, stand.place), at.one_cell);
    for (int i = 0; i < kSets; ++i) {
      const VF weight = hn::Mul(standing, probe_sight(*views[i], line));
      const V3 light = probe_light(*views[i], probe, at.light_taps, at.one_cell && at.one_normal);
      sums[i].light = mul_add(weight, light, sums[i].light);
      sums[i].weights = hn::Add(sums[i].weights, weight);
    }
  }
}

// Indirect light of hits [0, count); of catchers also what they receive without the virtual objects.
HWY_NOINLINE inline void indirect_light(const TileJob& job, HitBatch& hits, int count) {
  const ShadingInputs& shading = *job.shading;
  for (int slot = 0; slot < count; slot += kLanes) {
    const MF catcher = of_kind(hits, slot, HitKind::catcher);
    const MF surface = hn::Or(of_kind(hits, slot, HitKind::object), catcher);
    if (hn::AllFalse(kF, surface)) {
      store3({hn::Zero(kF), hn::Zero(kF), hn::Zero(kF)}, hits.indirect, slot);
      continue;
    }
    const LookupPoint at = lookup_point(*shading.probes, hits, slot, surface);
    if (shading.catcher_probes == nullptr || hn::AllFalse(kF, catcher)) {
      ProbeSum sums[1];
      ask_probes<1>({shading.probes}, at, sums);
      store3(sums[0].radiance(shading, *shading.probes, at), hits.indirect, slot);
      continue;
    }
    ProbeSum sums[2];
    ask_probes<2>({shading.probes, shading.catcher_probes}, at, sums);
    store3(sums[0].radiance(shading, *shading.probes, at), hits.indirect, slot);
    store3(sums[1].radiance(shading, *shading.catcher_probes, at), hits.indirect_without, slot);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
