#include "server/study/error/high_percentile.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

namespace herr {
namespace {

// 32 bins for each power of two; the bits of floats from 0 on are in the order of the floats.
constexpr std::uint32_t kBinShift = 18;
constexpr std::size_t kBins = (std::bit_cast<std::uint32_t>(1.0f) >> kBinShift) + 1;
constexpr std::size_t kChunkPixels = 65536;

std::size_t bin_of(float value) {
  return std::min<std::size_t>(std::bit_cast<std::uint32_t>(value) >> kBinShift, kBins - 1);
}

struct PercentileChunk {
  std::size_t viewport, first, end;
  std::vector<std::uint32_t> counts;              // [band][bin], the last band has none
  std::array<std::vector<float>, kBands> in_bin;  // what lies in the bin of the percentile
};

std::vector<PercentileChunk> percentile_chunks(std::span<const ViewportMap> maps) {
  std::vector<PercentileChunk> chunks;
  for (std::size_t v = 0; v < maps.size(); ++v) {
    const std::size_t pixels = maps[v].band.size();
    for (std::size_t first = 0; first < pixels; first += kChunkPixels)
      chunks.push_back({v, first, std::min(first + kChunkPixels, pixels), {}, {}});
  }
  return chunks;
}

// A band's histogram, and the bin that holds the value of the percentile's rank.
struct PercentileBin {
  std::vector<std::int64_t> counts = std::vector<std::int64_t>(kBins);
  std::size_t bin = kBins;       // none: no value
  std::int64_t rank_in_bin = 0;  // from 0

  void find() {
    std::int64_t total = 0, below = 0;
    for (const std::int64_t count : counts) total += count;
    const std::int64_t rank = (999 * total + 999) / 1000;  // ceil(0.999 n) in whole numbers
    for (std::size_t b = 0; b < kBins && bin == kBins; below += counts[b], ++b) {
      if (total > 0 && below + counts[b] >= rank) {
        bin = b;
        rank_in_bin = rank - below - 1;
      }
    }
  }
};

void count_chunk(const ViewportMap& map, const std::vector<float>& values, PercentileChunk& chunk) {
  chunk.counts.assign(kAllPixels * kBins, 0);
  for (std::size_t i = chunk.first; i < chunk.end; ++i) {
    if (map.band[i] != kNotSeen) ++chunk.counts[map.band[i] * kBins + bin_of(values[i])];
  }
}

void pick_chunk(const ViewportMap& map, const std::vector<float>& values,
                const std::array<PercentileBin, kBands>& bins, PercentileChunk& chunk) {
  for (std::size_t i = chunk.first; i < chunk.end; ++i) {
    const std::size_t band = map.band[i];
    if (band == kNotSeen) continue;
    const std::size_t bin = bin_of(values[i]);
    if (bin == bins[band].bin) chunk.in_bin[band].push_back(values[i]);
    if (bin == bins[kAllPixels].bin) chunk.in_bin[kAllPixels].push_back(values[i]);
  }
}

double value_at_rank(const std::vector<PercentileChunk>& chunks, std::size_t band, std::int64_t rank) {
  std::vector<float> values;
  for (const PercentileChunk& chunk : chunks)
    values.insert(values.end(), chunk.in_bin[band].begin(), chunk.in_bin[band].end());
  const auto nth = values.begin() + rank;
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace

std::array<double, kBands> high_percentiles(std::span<const ViewportMap> maps,
                                            std::span<const std::vector<float>> values,
                                            const ParallelFor& parallel_for) {
  std::vector<PercentileChunk> chunks = percentile_chunks(maps);
  const auto for_chunks = [&](auto&& work) {
    parallel_for(static_cast<int>(chunks.size()), [&](int job) {
      PercentileChunk& chunk = chunks[static_cast<std::size_t>(job)];
      work(maps[chunk.viewport], values[chunk.viewport], chunk);
    });
  };
  for_chunks(count_chunk);
  std::array<PercentileBin, kBands> bins;
  for (const PercentileChunk& chunk : chunks) {
    for (std::size_t i = 0; i < chunk.counts.size(); ++i) {
      bins[i / kBins].counts[i % kBins] += chunk.counts[i];
      bins[kAllPixels].counts[i % kBins] += chunk.counts[i];
    }
  }
  for (PercentileBin& bin : bins) bin.find();
  for_chunks([&](const ViewportMap& map, const std::vector<float>& of_map, PercentileChunk& chunk) {
    pick_chunk(map, of_map, bins, chunk);
  });
  std::array<double, kBands> result;
  result.fill(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t band = 0; band < kBands; ++band) {
    if (bins[band].bin < kBins) result[band] = value_at_rank(chunks, band, bins[band].rank_in_bin);
  }
  return result;
}

}  // namespace herr
