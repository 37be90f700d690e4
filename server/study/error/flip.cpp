#include "server/study/error/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "server/study/error/flip_colour.h"
#include "server/study/error/flip_filters.h"

namespace herr {
namespace {

// A tile of whole blocks, and the strip of tiles that is one job.
constexpr std::size_t kTileWidth = 128, kStripHeight = 64;
constexpr double kMostPixelsPerDegree = 500;

// What filters along rows leave of one picture's tile: one plane for each, rows of kTileWidth.
enum RowFilter : std::size_t { achromatic, red_green, by_wide, by_narrow, smooth, edge, point, kRowFilters };

// One row of a tile of one picture after all filters.
struct FlipRow {
  std::array<std::array<float, kTileWidth>, 3> lab;
  std::array<float, kTileWidth> edges, points;
};

// Works through the tiles of a strip. Not for two threads at a time.
class FlipStrip {
 public:
  explicit FlipStrip(const FlipFilters& filters)
      : filters_(filters),
        margin_(static_cast<std::size_t>(filters.radius)),
        // Blocks that begin within the row may end beyond it.
        padded_((kTileWidth + 2 * margin_ + kFlipBlock - 1) / kFlipBlock * kFlipBlock) {
    for (auto& channel : ycxcz_) channel.resize(padded_);
    for (auto& picture : planes_) {
      for (auto& plane : picture) plane.resize(kTileWidth * (kStripHeight + 2 * margin_));
    }
  }

  // Rows from `top` to `end` and kTileWidth columns from `left` on, as far as the picture reaches.
  void tile(const LinearPicture& test, const LinearPicture& reference, std::size_t left, std::size_t top,
            std::size_t end, std::vector<float>& out) {
    filter_rows(test, left, top, end, planes_[0]);
    filter_rows(reference, left, top, end, planes_[1]);
    const auto width = static_cast<std::size_t>(test.width_px);
    for (std::size_t y = top; y < end; ++y) {
      filter_columns(planes_[0], y - top, rows_[0]);
      filter_columns(planes_[1], y - top, rows_[1]);
      compare(std::min(kTileWidth, width - left), out.data() + width * y + left);
    }
  }

 private:
  using Planes = std::array<std::vector<float>, kRowFilters>;

  // The colours of a row of the picture around a tile, the picture's borders repeated.
  void read_row(const LinearPicture& picture, std::size_t left, std::size_t y) {
    const std::size_t first = y * static_cast<std::size_t>(picture.width_px);
    const std::ptrdiff_t last = picture.width_px - 1;
    for (std::size_t begin = 0; begin < padded_; begin += kFlipBlock) {
      FlipBlock block;
      for (std::size_t i = 0; i < kFlipBlock; ++i) {
        const auto x = static_cast<std::ptrdiff_t>(left + begin + i) - static_cast<std::ptrdiff_t>(margin_);
        const auto at = first + static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(x, 0, last));
        for (std::size_t c = 0; c < 3; ++c) block[c][i] = picture.plane[c][at];
      }
      ycxcz_from_linear(block);
      for (std::size_t c = 0; c < 3; ++c)
        std::copy(block[c].begin(), block[c].end(), ycxcz_[c].data() + begin);
    }
  }

  void filter_rows(const LinearPicture& picture, std::size_t left, std::size_t top, std::size_t end,
                   Planes& planes) {
    const std::ptrdiff_t last = picture.height_px - 1;
    for (std::size_t row = 0; row < end - top + 2 * margin_; ++row) {
      const auto y = static_cast<std::ptrdiff_t>(top + row) - static_cast<std::ptrdiff_t>(margin_);
      read_row(picture, left, static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(y, 0, last)));
      const auto filter = [&](const FlipFilter& with, std::size_t channel, RowFilter to) {
        flip_convolve(with, ycxcz_[channel].data() + margin_, 1, kTileWidth, &planes[to][row * kTileWidth]);
      };
      filter(filters_.achromatic, 0, achromatic);
      filter(filters_.red_green, 1, red_green);
      filter(filters_.wide_rows, 2, by_wide);
      filter(filters_.narrow_rows, 2, by_narrow);
      filter(filters_.smooth, 0, smooth);
      filter(filters_.edge, 0, edge);
      filter(filters_.point, 0, point);
    }
  }

  // `y`: from the tile's top.
  void filter_columns(const Planes& planes, std::size_t y, FlipRow& row) {
    std::array<std::array<float, kTileWidth>, 4> detected;
    std::array<float, kTileWidth> narrow;
    const auto filter = [&](const FlipFilter& with, RowFilter from, std::array<float, kTileWidth>& to) {
      flip_convolve(with, &planes[from][(y + margin_) * kTileWidth], kTileWidth, kTileWidth, to.data());
    };
    filter(filters_.achromatic, achromatic, row.lab[0]);
    filter(filters_.red_green, red_green, row.lab[1]);
    filter(filters_.wide_columns, by_wide, row.lab[2]);
    filter(filters_.narrow_columns, by_narrow, narrow);
    for (std::size_t i = 0; i < kTileWidth; ++i) row.lab[2][i] += narrow[i];
    for (std::size_t begin = 0; begin < kTileWidth; begin += kFlipBlock) {
      FlipBlock block;
      for (std::size_t c = 0; c < 3; ++c) std::copy_n(row.lab[c].data() + begin, kFlipBlock, block[c].data());
      hunt_lab_from_ycxcz(block);
      for (std::size_t c = 0; c < 3; ++c)
        std::copy(block[c].begin(), block[c].end(), row.lab[c].data() + begin);
    }
    filter(filters_.smooth, edge, detected[0]);
    filter(filters_.edge, smooth, detected[1]);
    filter(filters_.smooth, point, detected[2]);
    filter(filters_.point, smooth, detected[3]);
    const auto length = [](float x, float y_part) { return std::sqrt(x * x + y_part * y_part); };
    for (std::size_t i = 0; i < kTileWidth; ++i) {
      row.edges[i] = length(detected[0][i], detected[1][i]);
      row.points[i] = length(detected[2][i], detected[3][i]);
    }
  }

  void compare(std::size_t count, float* out) const {
    // Features are those of (Y + 16) / 116; detectors have sum 0, so that 16 falls out.
    constexpr float kFeatureScale = static_cast<float>(1 / (116 * std::numbers::sqrt2));
    const FlipRow &a = rows_[0], &b = rows_[1];
    for (std::size_t i = 0; i < count; ++i) {
      const float colour = flip_colour_difference(a.lab[0][i] - b.lab[0][i], a.lab[1][i] - b.lab[1][i],
                                                  a.lab[2][i] - b.lab[2][i]);
      const float feature = std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
      const float share = std::min(std::sqrt(kFeatureScale * feature), 1.0f);
      out[i] = std::min(std::pow(colour, 1 - share), 1.0f);
    }
  }

  const FlipFilters& filters_;
  std::size_t margin_, padded_;
  std::array<std::vector<float>, 3> ycxcz_;
  std::array<Planes, 2> planes_;
  std::array<FlipRow, 2> rows_;
};

}  // namespace

void flip_map(const LinearPicture& test, const LinearPicture& reference, double pixels_per_degree,
              const ParallelFor& parallel_for, std::vector<float>& out) {
  const FlipFilters filters(std::min(pixels_per_degree, kMostPixelsPerDegree));
  const auto width = static_cast<std::size_t>(test.width_px),
             height = static_cast<std::size_t>(test.height_px);
  out.resize(width * height);
  parallel_for(static_cast<int>((height + kStripHeight - 1) / kStripHeight), [&](int job) {
    const std::size_t top = static_cast<std::size_t>(job) * kStripHeight;
    FlipStrip strip(filters);
    for (std::size_t left = 0; left < width; left += kTileWidth)
      strip.tile(test, reference, left, top, std::min(top + kStripHeight, height), out);
  });
}

}  // namespace herr
