// Which stratum of a lamp each hit looks at, round by round. In each round the sixteen places of a 4x4 block
// look at sixteen strata in a row of strata_order, in samples / 16 rounds at all of them, and the four of a
// quad in four rounds at sixteen parts of the lamp; a hit itself goes from part to part. Blocks are turned by
// random sixteenths of the order, and all of them by a random number of the frame and eye, so that each hit
// meets each stratum equally often. Before: light records. After: adaptive_light-inl.h. Source: Keller &
// Heidrich, "Interleaved Sampling", 2001.
#pragma once

#include "renderer/direct_light/light_samples-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Where a hit begins: its rank in its block, and the turn of its block.
constexpr int kRanks = 16, kTurns = 16, kStarts = kRanks * kTurns;

// A hit of rank k and turn t looks at entry begin + (k ^ flip) + t samples / 16 of the order, or, of a number
// of samples that sixteen does not divide, at begin + (k + t) samples / 16.
struct LightRound {
  int begin = 0;
  int flip = -1;  // below 0: sixteen does not divide the samples

  LightRound(const LightRecord& light, std::uint32_t frame_key, int round) {
    constexpr std::uint32_t kTurn = 1u << 18;  // beyond the light's own numbers, below those of its shadows
    const float random = hn::GetLane(unit_float(hash(hn::Set(kU, frame_key), light.key + kTurn)));
    begin = static_cast<int>(random * static_cast<float>(light.samples));
    if (light.samples % kRanks != 0) {
      begin += round;
    } else {
      // Four rounds take a hit to four of sixteen parts, a quad to all, and each half of a block to the same
      // number of strata of either half of them: turning a part's halves by quads, those of strata by rows.
      constexpr std::array<int, 4> kTurned{0, 3, 1, 2}, kSwapped{0, 2, 1, 3};
      const int four = round & 3, quads = four ^ kTurned[static_cast<std::size_t>(round / 4 % 4)];
      begin += kRanks * (round - four + kSwapped[static_cast<std::size_t>(four)] + round / kRanks);
      flip = (round & 3) | quads << 2;
    }
    begin %= light.samples;
  }

  HWY_INLINE VI stratum(const LightRecord& light, VI start) const {
    const VI samples = hn::Set(kI, light.samples), sixteen = hn::Set(kI, kRanks - 1);
    const VI rank = hn::And(start, sixteen), turn = hn::ShiftRight<4>(start);
    const auto sixteenths = [&](VI of) HWY_ATTR { return hn::ShiftRight<4>(hn::Mul(of, samples)); };
    const VI from_begin = flip < 0 ? sixteenths(hn::And(hn::Add(rank, turn), sixteen))
                                   : hn::Add(hn::Xor(rank, hn::Set(kI, flip)), sixteenths(turn));
    const auto wrap = [&](VI entry) HWY_ATTR {
      return hn::IfThenElse(hn::Lt(entry, samples), entry, hn::Sub(entry, samples));
    };
    return hn::GatherIndex(kI, light.order.data(), wrap(wrap(hn::Add(hn::Set(kI, begin), from_begin))));
  }
};

// Fills where hits [0, count) begin.
HWY_INLINE void find_starts(const TileJob& job, const LightRecord& light, const HitBatch& hits, int count,
                            AdaptiveLight& adaptive) {
  std::array<std::int32_t, kBlocksInTile> turns;
  for (std::size_t block = 0; block < kBlocksInTile; ++block) {
    const auto x = static_cast<std::uint32_t>(job.x0) / 4 + static_cast<std::uint32_t>(block % kBlocksAlong);
    const auto y = static_cast<std::uint32_t>(job.y0) / 4 + static_cast<std::uint32_t>(block / kBlocksAlong);
    constexpr std::uint32_t kBlockTurn = (1u << 18) + 1;
    const VU key = hn::Set(kU, job.grid->key ^ (y << 16 | x) * 0x9e3779b9u);
    const float random = hn::GetLane(unit_float(hash(key, light.key + kBlockTurn)));
    turns[block] = static_cast<std::int32_t>(random * kTurns);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
    adaptive.start[i] = hits.rank[i] + kRanks * turns[hits.block[i]];
}
HWY_INLINE VI start_of(const AdaptiveLight& adaptive, int slot) {
  return hn::Load(kI, &adaptive.start[slot]);
}

// way_to_light() of a stratum of each lane's own: the same place in it.
HWY_INLINE V3 way_to_stratum(const LightRecord& light, VI stratum, const HitBatch& hits, int slot) {
  const VU key = hn::Load(kU, &hits.key[slot]);
  const int nx = light.strata[0], ny = light.strata[1];
  const auto over = [](VF whole, int by) HWY_ATTR {
    return hn::Floor(hn::Mul(hn::Add(whole, set(0.5f)), set(1.0f / static_cast<float>(by))));
  };
  const VF all = hn::ConvertTo(kF, stratum), rows = over(all, nx), planes = over(rows, ny);
  const VF cell[3] = {hn::NegMulAdd(rows, set(static_cast<float>(nx)), all),
                      hn::NegMulAdd(planes, set(static_cast<float>(ny)), rows), planes};
  VF point[3];
  const VU numbers = hn::Add(hn::Mul(hn::BitCast(kU, stratum), hn::Set(kU, 3)), hn::Set(kU, light.key));
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const VF jitter = unit_float(hash(key, hn::Add(numbers, hn::Set(kU, axis))));
    const VF width = set(light.size[axis] / static_cast<float>(light.strata[axis]));
    const VF lower = hn::Add(set(light.lower[axis]), hn::Mul(width, cell[axis]));
    point[axis] = hn::MulAdd(jitter, width, lower);
  }
  return sub(V3{point[0], point[1], point[2]}, load3(hits.position, slot));
}

// The sum of the places of the strata that a hit looks at, by where it begins (ShadingPoints::stratum_at).
struct PlaceSums {
  std::array<std::array<float, kStarts>, 3> of_axis{};

  void add(const LightRecord& light, const ShadingPoints& points, std::uint32_t frame_key, int from, int to) {
    for (int round = from; round < to; ++round) {
      const LightRound at(light, frame_key, round);
      for (int first = 0; first < kStarts; first += kLanes) {
        const VI strata = at.stratum(light, hn::Iota(kI, first));
        for (std::size_t axis = 0; axis < 3; ++axis) {
          float* sum = &of_axis[axis][static_cast<std::size_t>(first)];
          const VF place = hn::GatherIndex(kF, points.stratum_at[axis].data(), strata);
          hn::StoreU(hn::Add(hn::LoadU(kF, sum), place), kF, sum);
        }
      }
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
