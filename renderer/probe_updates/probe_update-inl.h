// Radiance of this frame's probe rays -> the light that probes have gathered -> the packed copy for look-ups.
// Lanes are probes: all share the frame's ray directions, and so the weights of rays in each node.
// x <- h x + (1 - h) new^(1/gamma) with gamma = 5, so that darkening is not slower to the eye than
// brightening (Majercik et al. 2019).
#pragma once

#include <hwy/contrib/math/math-inl.h>

#include "renderer/probe_updates/probe_job.h"
#include "renderer/simd/simd_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// A change of a quarter is large; from a half on, probes forget 16 times as fast.
constexpr float kLargeChange = 0.25f, kLargestChange = 0.5f;
// A change is also larger than this many standard errors of as many independent rays, now or before: one ray
// that meets a small bright spot counts as noise.
constexpr float kSurelyChanged = 1.5f;

HWY_INLINE VF fifth_root(VF x) {
  const MF some = hn::Gt(x, set(1e-30f));
  return hn::IfThenElseZero(some, hn::Exp(kF, hn::Mul(hn::Log(kF, hn::Max(x, set(1e-30f))), set(0.2f))));
}
HWY_INLINE VF fifth_power(VF x) {
  const VF x2 = hn::Mul(x, x);
  return hn::Mul(hn::Mul(x2, x2), x);
}
HWY_INLINE VF mix(VF kept, VF before, VF now) {
  return hn::MulAdd(kept, hn::Sub(before, now), now);
}
HWY_INLINE VF luminance(VF r, VF g, VF b) {
  return hn::MulAdd(r, set(0.2126f), hn::MulAdd(g, set(0.7152f), hn::Mul(b, set(0.0722f))));
}

// kLanes of a job's probes, from lane `first` on.
struct ProbeGroup {
  int first = 0, count = 0;
  VI probes;  // the last one repeated in idle lanes
  MF lanes;   // those in use
  VF kept;    // share of what was gathered that stays
};

HWY_INLINE ProbeGroup probe_group(const ProbeJob& job, int first) {
  const auto probes = job.volume->job_probes(job.job);
  const auto keeps = job.volume->job_keeps(job.job);
  ProbeGroup group;
  group.first = first;
  group.count =
      static_cast<int>(probes.size()) - first < kLanes ? static_cast<int>(probes.size()) - first : kLanes;
  alignas(64) std::int32_t index[kMaxLanes] = {};
  alignas(64) float kept[kMaxLanes] = {};
  for (int i = 0; i < kLanes; ++i) {
    const auto from = static_cast<std::size_t>(first + (i < group.count ? i : group.count - 1));
    index[i] = probes[from], kept[i] = keeps[from];
  }
  group.probes = hn::Load(kI, index);
  group.kept = load(kept);
  group.lanes = first_lanes(group.count);
  return group;
}

HWY_INLINE V3 ray_light(const ProbeJob& job, const ProbeGroup& group, int ray) {
  const ProbeLanes* channel = job.radiance + kProbeRayLanes * static_cast<std::size_t>(ray);
  return load3(channel[0].of_probe + group.first, channel[1].of_probe + group.first,
               channel[2].of_probe + group.first);
}

HWY_INLINE VF ray_open(const ProbeJob& job, const ProbeGroup& group, int ray) {
  return load(job.radiance[kProbeRayLanes * static_cast<std::size_t>(ray) + 3].of_probe + group.first);
}

// Mean luminance of this frame's rays and its mean square.
struct RayStatistics {
  VF mean, square;
};
HWY_INLINE RayStatistics ray_statistics(const ProbeJob& job, const ProbeGroup& group) {
  const int rays = job.volume->directions.rays();
  RayStatistics now{hn::Zero(kF), hn::Zero(kF)};
  for (int ray = 0; ray < rays; ++ray) {
    const V3 light = ray_light(job, group, ray);
    const VF y = luminance(light.x, light.y, light.z);
    now.mean = hn::Add(now.mean, y);
    now.square = hn::MulAdd(y, y, now.square);
  }
  const VF share = set(1.0f / static_cast<float>(rays));
  return {hn::Mul(now.mean, share), hn::Mul(now.square, share)};
}

// Less cannot be seen.
HWY_INLINE float dark_radiance(const ProbeJob& job) {
  return kDarkShare * job.tile.shading->shown_white;
}

// How large the change is, and the share that a probe keeps: less where it is large and beyond what the
// rays' scatter explains.
struct Reaction {
  VF change, kept;
  MF reacts;
};
HWY_INLINE Reaction reaction(const ProbeJob& job, const ProbeGroup& group, const RayStatistics& now, VF mean,
                             VF square) {
  const VF difference = hn::Abs(hn::Sub(now.mean, mean));
  const VF change = hn::Div(difference, hn::Max(hn::Max(now.mean, mean), set(dark_radiance(job))));
  const MF known = hn::Gt(group.kept, hn::Zero(kF));
  Reaction out{hn::IfThenElseZero(hn::And(known, group.lanes), change), group.kept, first_lanes(0)};
  if (!job.volume->settings.react) return out;
  const auto variance = [](VF m, VF m2) HWY_ATTR { return hn::NegMulAdd(m, m, m2); };
  const VF scatter2 =
      hn::Mul(hn::Max(variance(mean, square), variance(now.mean, now.square)),
              set(kSurelyChanged * kSurelyChanged / static_cast<float>(job.volume->directions.rays())));
  const MF large =
      hn::And(hn::Gt(change, set(kLargeChange)), hn::Gt(hn::Mul(difference, difference), scatter2));
  out.reacts = hn::And(hn::And(known, large), group.lanes);
  const VF h = group.kept, h2 = hn::Mul(h, h), h4 = hn::Mul(h2, h2), h8 = hn::Mul(h4, h4);
  const VF extent = hn::Min(
      hn::Mul(hn::Sub(change, set(kLargeChange)), set(1 / (kLargestChange - kLargeChange))), set(1.0f));
  out.kept = hn::IfThenElse(out.reacts, mix(extent, hn::Mul(h8, h8), h), h);
  return out;
}

// What rays bring to a node: weighted, and in a filtered environment by shares of the sky where they met
// nothing.
template <bool kSky>
HWY_INLINE V3 light_of_node(const ProbeJob& job, const ProbeGroup& group, std::size_t node) {
  const ProbeDirections& directions = job.volume->directions;
  V3 sum{hn::Zero(kF), hn::Zero(kF), hn::Zero(kF)};
  const auto end = static_cast<std::size_t>(directions.first_weight[node + 1]);
  for (auto i = static_cast<std::size_t>(directions.first_weight[node]); i < end; ++i) {
    const auto [ray, weight] = directions.weights[i];
    V3 light = ray_light(job, group, ray);
    if constexpr (kSky) {
      const VF open = ray_open(job, group, ray);
      light = only(hn::Eq(open, hn::Zero(kF)), light);
      sum = mul_add(open, set3(directions.sky[i].light), sum);
    }
    sum = mul_add(set(weight), light, sum);
  }
  return sum;
}

HWY_INLINE void blend_light(const ProbeJob& job, const ProbeGroup& group, VF kept) {
  const ProbeVolume& volume = *job.volume;
  const bool sky = !volume.directions.sky.empty();
  float* gathered = job.volume->sets[static_cast<std::size_t>(job.set)].gathered.data();
  const VI base = hn::Mul(group.probes, hn::Set(kI, kLightFloats));
  for (std::size_t node = 0; node < volume.node_directions.size(); ++node) {
    const V3 sum = sky ? light_of_node<true>(job, group, node) : light_of_node<false>(job, group, node);
    int channel = 0;
    for (const VF light : {sum.x, sum.y, sum.z}) {
      float* const to = gathered + channel++ * kLightChannel + node;
      const VF before = hn::GatherIndex(kF, to, base);
      const VF now = mix(kept, before, fifth_root(light));
      alignas(64) float value[kMaxLanes];
      alignas(64) std::int32_t index[kMaxLanes];
      hn::Store(now, kF, value);
      hn::Store(base, kI, index);
      for (int i = 0; i < group.count; ++i) to[index[i]] = value[i];
    }
  }
}

// Statistics of each probe and whether it lay in the dark once more.
HWY_INLINE void note_statistics(const ProbeJob& job, const ProbeGroup& group, const RayStatistics& now,
                                VF kept) {
  ProbeSet& set_of = job.volume->sets[static_cast<std::size_t>(job.set)];
  const VF mean = mix(kept, hn::GatherIndex(kF, set_of.mean.data(), group.probes), now.mean);
  const VF square = mix(kept, hn::GatherIndex(kF, set_of.square.data(), group.probes), now.square);
  alignas(64) float means[kMaxLanes], squares[kMaxLanes], brightest[kMaxLanes];
  hn::Store(mean, kF, means);
  hn::Store(square, kF, squares);
  hn::Store(hn::Max(mean, now.mean), kF, brightest);
  const auto probes = job.volume->job_probes(job.job);
  const float darkest = dark_radiance(job);
  for (int i = 0; i < group.count; ++i) {
    const auto probe = static_cast<std::size_t>(probes[static_cast<std::size_t>(group.first + i)]);
    set_of.mean[probe] = means[i];
    set_of.square[probe] = squares[i];
    std::uint8_t& dark = set_of.dark_updates[probe];
    if (brightest[i] > darkest) {
      dark = 0;
    } else if (dark < kUpdatesToSleep) {
      ++dark;
    }
  }
}

void blend_probes(const ProbeJob& job) {
  const ProbeSet& set_of = job.volume->sets[static_cast<std::size_t>(job.set)];
  const int probes = static_cast<int>(job.volume->job_probes(job.job).size());
  ProbeJobResult& result = job.volume->results[static_cast<std::size_t>(job.job) * job.volume->sets.size() +
                                               static_cast<std::size_t>(job.set)];
  result.change = 0;
  result.reacting = 0;
  for (int first = 0; first < probes; first += kLanes) {
    const ProbeGroup group = probe_group(job, first);
    const RayStatistics now = ray_statistics(job, group);
    const Reaction react = reaction(job, group, now, hn::GatherIndex(kF, set_of.mean.data(), group.probes),
                                    hn::GatherIndex(kF, set_of.square.data(), group.probes));
    blend_light(job, group, react.kept);
    note_statistics(job, group, now, react.kept);
    alignas(64) float changes[kMaxLanes];
    hn::Store(react.change, kF, changes);
    for (int i = 0; i < group.count; ++i) result.change += static_cast<double>(changes[i]);
    result.reacting += static_cast<std::int32_t>(hn::CountTrue(kF, react.reacts));
  }
}

// 21 bits of a float that is not negative, rounded to nearest.
HWY_INLINE VU light_bits(VF x) {
  return hn::ShiftRight<10>(hn::Add(hn::BitCast(kU, x), hn::Set(kU, 0x200u)));
}

void publish_probes(const ProbeJob& job) {
  ProbeVolume& volume = *job.volume;
  ProbeSet& set_of = volume.sets[static_cast<std::size_t>(job.set)];
  const int nodes = static_cast<int>(volume.node_directions.size());
  alignas(64) std::uint32_t words[kLightWords][kLightChannel + kMaxLanes];
  for (const std::int32_t probe : volume.job_probes(job.job)) {
    const auto p = static_cast<std::size_t>(probe);
    const float* gathered = &set_of.gathered[p * kLightFloats];
    for (int node = 0; node < nodes; node += kLanes) {
      const VU r = light_bits(fifth_power(loadu(gathered + node)));
      const VU g = light_bits(fifth_power(loadu(gathered + kLightChannel + node)));
      const VU b = light_bits(fifth_power(loadu(gathered + 2 * kLightChannel + node)));
      hn::Store(hn::Or(hn::ShiftLeft<11>(r), hn::ShiftRight<10>(b)), kU, &words[0][node]);
      hn::Store(hn::Or(hn::ShiftLeft<11>(g), hn::And(b, hn::Set(kU, 0x3ffu))), kU, &words[1][node]);
    }
    std::uint32_t* light = &set_of.light[p * LightNodes::kCount * kLightWords];
    int unique = 0;
    for (int node = 0; node < LightNodes::kCount; ++node) {
      const int first = LightNodes::first_of(node);
      for (int word = 0; word < kLightWords; ++word) {
        light[node * kLightWords + word] =
            first == node ? words[word][unique] : light[first * kLightWords + word];
      }
      if (first == node) ++unique;
    }
    set_of.places[4 * p + 3] = 1.0f;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
