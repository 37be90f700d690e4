#include "server/study/error/picture_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "server/study/error/acuity_filter.h"
#include "server/study/error/flip.h"
#include "server/study/error/high_percentile.h"

namespace herr {
namespace {

constexpr std::size_t kRowsPerJob = 16;

// Over the pixels of one band.
struct BandSums {
  double count = 0, squares = 0, relative = 0, largest = 0, weight = 0, visible = 0, flip = 0;

  void add(const BandSums& other) {
    count += other.count;
    squares += other.squares;
    relative += other.relative;
    largest = std::max(largest, other.largest);
    weight += other.weight;
    visible += other.visible;
    flip += other.flip;
  }
};
using RowSums = std::array<BandSums, kAllPixels>;

// One viewport's pictures and what is worked out from them. Rows are summed each for itself and then added in
// their order, so the number of threads changes no bit.
class ViewportErrors {
 public:
  ViewportErrors(const ViewportMap& map, const LinearPicture& test, const LinearPicture& reference,
                 const ParallelFor& parallel_for)
      : map_(map), test_(test), reference_(reference), parallel_for_(parallel_for) {}

  // `largest`: of each pixel's channels. Without `with_flip` the sums of FLIP stay 0.
  RowSums sum(std::vector<float>& largest, bool with_flip) {
    largest.resize(map_.band.size());
    difference_ = {map_.width_px, map_.height_px, {}};
    for (auto& plane : difference_.plane) plane.resize(map_.band.size());
    rows_.assign(static_cast<std::size_t>(map_.height_px), {});
    for_rows([&](std::size_t first, std::size_t end, RowSums& sums) { measure(first, end, sums, largest); });
    low_pass_at_acuity(map_, difference_, parallel_for_);
    flip_.assign(with_flip ? 0 : map_.band.size(), 0.0f);
    if (with_flip) flip_map(test_, reference_, map_.pixels_per_degree, parallel_for_, flip_);
    for_rows([&](std::size_t first, std::size_t end, RowSums& sums) { measure_seen(first, end, sums); });
    RowSums total;
    for (const RowSums& row : rows_) {
      for (std::size_t band = 0; band < kAllPixels; ++band) total[band].add(row[band]);
    }
    return total;
  }

 private:
  template <class Work>
  void for_rows(const Work& work) {
    const auto width = static_cast<std::size_t>(map_.width_px);
    const std::size_t jobs = (rows_.size() + kRowsPerJob - 1) / kRowsPerJob;
    parallel_for_(static_cast<int>(jobs), [&](int job) {
      const std::size_t first = static_cast<std::size_t>(job) * kRowsPerJob;
      for (std::size_t y = first; y < std::min(first + kRowsPerJob, rows_.size()); ++y)
        work(width * y, width * (y + 1), rows_[y]);
    });
  }

  void measure(std::size_t first, std::size_t end, RowSums& sums, std::vector<float>& largest) {
    for (std::size_t i = first; i < end; ++i) {
      float squares = 0, relative = 0, most = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const float reference = reference_.plane[c][i], d = test_.plane[c][i] - reference;
        difference_.plane[c][i] = d;
        squares += d * d;
        relative += d * d / (reference * reference + 0.01f);
        most = std::max(most, std::abs(d));
      }
      largest[i] = most;
      if (map_.band[i] == kNotSeen) continue;
      BandSums& of_band = sums[map_.band[i]];
      of_band.count += 1;
      of_band.squares += static_cast<double>(squares);
      of_band.relative += static_cast<double>(relative);
      of_band.largest = std::max(of_band.largest, static_cast<double>(most));
    }
  }

  // After the low-pass.
  void measure_seen(std::size_t first, std::size_t end, RowSums& sums) const {
    for (std::size_t i = first; i < end; ++i) {
      if (map_.band[i] == kNotSeen) continue;
      double squares = 0;
      for (const auto& plane : difference_.plane) {
        const auto d = static_cast<double>(plane[i]);
        squares += d * d;
      }
      const double weight = acuity_weight(static_cast<double>(map_.eccentricity_deg[i]),
                                          static_cast<double>(map_.solid_angle_sr[i]));
      BandSums& of_band = sums[map_.band[i]];
      of_band.weight += weight;
      of_band.visible += weight * squares / 3;
      of_band.flip += static_cast<double>(flip_[i]);
    }
  }

  const ViewportMap& map_;
  const LinearPicture &test_, &reference_;
  const ParallelFor& parallel_for_;
  LinearPicture difference_;
  std::vector<float> flip_;
  std::vector<RowSums> rows_;
};

void check_sizes(std::span<const ViewportMap> maps, std::span<const LinearPicture> pictures) {
  bool same = maps.size() == pictures.size();
  for (std::size_t v = 0; same && v < maps.size(); ++v) {
    same = maps[v].width_px == pictures[v].width_px && maps[v].height_px == pictures[v].height_px;
    for (const auto& plane : pictures[v].plane) same = same && plane.size() == maps[v].band.size();
  }
  if (!same) throw std::invalid_argument("pictures and maps of viewports differ in number or size");
}

void fill_row(const BandSums& sums, double percentile, std::array<double, kMetrics>& row) {
  if (sums.count == 0) return;
  const auto set = [&](Metric metric, double value) { row[static_cast<std::size_t>(metric)] = value; };
  const double rmse = std::sqrt(sums.squares / (3 * sums.count));
  set(Metric::rmse, rmse);
  set(Metric::relative_mse, sums.relative / (3 * sums.count));
  set(Metric::p99_9, percentile);
  set(Metric::largest, sums.largest);
  if (rmse > 0) set(Metric::psnr_db, -20 * std::log10(rmse));
  set(Metric::acuity_rmse, std::sqrt(sums.visible / sums.weight));
  set(Metric::flip, sums.flip / sums.count);
}

}  // namespace

ErrorTable picture_errors(std::span<const ViewportMap> maps, std::span<const LinearPicture> test,
                          std::span<const LinearPicture> reference, const ParallelFor& parallel_for) {
  check_sizes(maps, test);
  check_sizes(maps, reference);
  std::array<BandSums, kBands> sums;
  std::vector<std::vector<float>> largest(maps.size());
  for (std::size_t v = 0; v < maps.size(); ++v) {
    const RowSums of_viewport =
        ViewportErrors(maps[v], test[v], reference[v], parallel_for).sum(largest[v], true);
    for (std::size_t band = 0; band < kAllPixels; ++band) sums[band].add(of_viewport[band]);
  }
  for (std::size_t band = 0; band < kAllPixels; ++band) sums[kAllPixels].add(sums[band]);
  const std::array<double, kBands> percentiles = high_percentiles(maps, largest, parallel_for);
  ErrorTable table;
  for (std::size_t band = 0; band < kBands; ++band)
    fill_row(sums[band], percentiles[band], table.value[band]);
  return table;
}

double acuity_weighted_rmse(std::span<const ViewportMap> maps, std::span<const LinearPicture> test,
                            std::span<const LinearPicture> reference, const ParallelFor& parallel_for) {
  check_sizes(maps, test);
  check_sizes(maps, reference);
  BandSums all;
  std::vector<float> largest;
  for (std::size_t v = 0; v < maps.size(); ++v) {
    for (const BandSums& band :
         ViewportErrors(maps[v], test[v], reference[v], parallel_for).sum(largest, false)) {
      all.add(band);
    }
  }
  return all.weight > 0 ? std::sqrt(all.visible / all.weight) : 0.0;
}

}  // namespace herr
