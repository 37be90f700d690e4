// Where further rays pass through the cells of polar samples at edges: the same places in every cell, the
// points of a rank-1 lattice around the sample itself, which is its first (with four further ones the rotated
// grid of multisampling hardware). Places come in opposite pairs, so that no picture is shifted. They depend
// on nothing but the cell, so that a still head and gaze give a still picture. Before: polar_samples. After:
// tracing/ sends rays through them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/foveation/polar_map.h"
#include "renderer/pixel_pass.h"

namespace herr {

class EdgePlaces {
 public:
  // Places [first, first + count) of one lattice.
  struct Set {
    int first = 0, count = 0;
  };
  static constexpr int kNeighbours = 8;
  // Sides of a cell: where columns and rows count down, and up.
  static constexpr std::int32_t kLeft = 1, kRight = 2, kAbove = 4, kBelow = 8;

  // Allocates for widths up to `max_width`, heights up to `max_height` and `count` places of a cell, an even
  // number above 0.
  EdgePlaces(int max_width, int max_height, int count);
  // New frame: as PolarSamples::update. No allocation.
  void update(const PolarMap& map, int width, int height);

  // The places of a cell, and those of one that errs less: half as many, in pairs.
  const Set& all() const { return all_; }
  const Set& few() const { return few_; }
  std::int64_t bytes() const;
  // The two sides next to place k. Where the cells beyond them show what the cell's sample shows, the place
  // does, too, unless something smaller than a cell lies there: a half plane that holds all three holds it.
  std::int32_t sides(int k) const { return sides_[static_cast<std::size_t>(k)]; }

  // Per place: the cell around that is the n-th nearest to it, 0 the nearest, in columns and rows from its
  // own.
  const std::int32_t* neighbour_column(int n) const {
    return neighbour_column_[static_cast<std::size_t>(n)].data();
  }
  const std::int32_t* neighbour_row(int n) const {
    return neighbour_row_[static_cast<std::size_t>(n)].data();
  }
  // Of place k and column or row i at k times columns() or rows(), plus i.
  const float* sin_theta() const { return sin_theta_.data(); }
  const float* cos_theta() const { return cos_theta_.data(); }
  const float* sin_phi() const { return sin_phi_.data(); }
  const float* cos_phi() const { return cos_phi_.data(); }
  int columns() const { return static_cast<int>(columns_); }
  int rows() const { return static_cast<int>(rows_); }

 private:
  void divide_circle(int height);

  int height_ = 0;
  std::size_t columns_, rows_;
  Set all_, few_;
  std::vector<CellPlace> places_;
  std::vector<std::int32_t> sides_;
  std::array<std::vector<std::int32_t>, kNeighbours> neighbour_column_, neighbour_row_;
  std::vector<float> sin_theta_, cos_theta_, sin_phi_, cos_phi_;
};

// The `count` points, an even number, of a lattice of count + 1 besides (0, 0), each in (-1/2, 1/2):
// (i, g i) / (count + 1), wrapped, with the g that keeps points farthest apart in the plane tiled with cells.
std::vector<CellPlace> lattice_places(int count);

}  // namespace herr
