// The filters of FLIP, each a product of one along rows and one along columns, sampled at whole pixels:
// contrast sensitivity by colour channel, edge and point detectors. Before: pixels per degree. After:
// flip.cpp. Source: Andersson et al. 2020, sections 4.1.1 and 4.2; constants of its table 1.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace herr {

// Rows are worked on in blocks of this many values, so that compilers make vectors of them.
inline constexpr std::size_t kFlipBlock = 16;

// Weights from -radius to radius.
struct FlipFilter {
  std::vector<float> weights;
  std::ptrdiff_t radius() const { return static_cast<std::ptrdiff_t>(weights.size() / 2); }
};

struct FlipFilters {
  // Along both axes, so that the sum of the product over the square is 1.
  FlipFilter achromatic, red_green;
  // Blue-yellow is the sum of two Gaussians: along rows as they are, along columns with their share.
  FlipFilter wide_rows, wide_columns, narrow_rows, narrow_columns;
  // The Gaussian (sum 1), its first and its second derivative (positive weights 1, negative ones -1).
  FlipFilter smooth, edge, point;
  std::ptrdiff_t radius = 0;  // the largest

  explicit FlipFilters(double pixels_per_degree);
};

// out[i] = sum of weights[k] * middle[i + k * step] for the `count` first i, a multiple of kFlipBlock.
void flip_convolve(const FlipFilter& filter, const float* middle, std::ptrdiff_t step, std::size_t count,
                   float* out);

}  // namespace herr
