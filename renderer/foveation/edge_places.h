// Where further rays pass through the cells of polar samples at edges: the same places in every cell, the
// points of a rank-1 lattice around the sample itself, which is its first (with four further ones the rotated
// grid of multisampling hardware). They depend on nothing but the cell, so that a still head and gaze give a
// still picture. Before: polar_samples. After: tracing/ sends rays through them.
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
  // A cell beside the one of a place, in columns and rows from it.
  struct Step {
    int column = 0, row = 0;
  };
  static constexpr std::size_t kNeighbours = 8;

  // Allocates `count` places for widths up to `max_width` and heights up to `max_height`.
  EdgePlaces(int max_width, int max_height, int count);
  // New frame: as PolarSamples::update. No allocation.
  void update(const PolarMap& map, int width, int height);

  int count() const { return static_cast<int>(places_.size()); }
  std::int64_t bytes() const;
  const CellPlace& place(int k) const { return places_[static_cast<std::size_t>(k)]; }
  // The cells around, nearest to place k first.
  const std::array<Step, kNeighbours>& neighbours(int k) const {
    return neighbours_[static_cast<std::size_t>(k)];
  }
  // Of place k: per column, and per row.
  const float* sin_theta(int k) const { return &sin_theta_[static_cast<std::size_t>(k) * columns_]; }
  const float* cos_theta(int k) const { return &cos_theta_[static_cast<std::size_t>(k) * columns_]; }
  const float* sin_phi(int k) const { return &sin_phi_[static_cast<std::size_t>(k) * rows_]; }
  const float* cos_phi(int k) const { return &cos_phi_[static_cast<std::size_t>(k) * rows_]; }

 private:
  void divide_circle(int height);

  int height_ = 0;
  std::size_t columns_, rows_;
  std::vector<CellPlace> places_;
  std::vector<std::array<Step, kNeighbours>> neighbours_;
  std::vector<float> sin_theta_, cos_theta_, sin_phi_, cos_phi_;
};

// The `count` points of a lattice of count + 1 besides (0, 0), each in [-1/2, 1/2]: (i, g i) / (count + 1),
// wrapped, with the g that keeps points farthest apart in the plane tiled with cells.
std::vector<CellPlace> lattice_places(int count);

}  // namespace herr
