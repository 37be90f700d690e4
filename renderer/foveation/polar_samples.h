// The sample directions of one eye's polar buffer for this frame, as separable tables: a direction is
// cos(theta_i) gaze + sin(theta_i) (cos(phi_j) right + sin(phi_j) up), samples at (i + 1/2) / W and (j + 1/2)
// / H. Before: gaze_frame. After: ray generation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/foveation/polar_map.h"
#include "renderer/pixel_pass.h"

namespace herr {

class PolarSamples {
 public:
  // Allocates for widths up to `max_width` and heights up to `max_height`, which are even. `reach`: a pixel
  // uses samples less than so many columns and rows away.
  PolarSamples(int max_width, int max_height, int reach = 1);

  // New frame: any width in [1, max_width], any even height in [2, max_height], any theta_max in (0, 180].
  // Directions go through `place` of each cell, its middle but for references. No allocation.
  void update(const PolarMap& map, int width, int height, const CellPlace& place = {});

  std::int64_t bytes() const;

  int width() const { return width_; }
  int height() const { return height_; }
  const PolarMap& map() const { return map_; }

  // Per column, padded with zeros to a multiple of 4 and 16 more.
  const float* sin_theta() const { return sin_theta_.data(); }
  const float* cos_theta() const { return cos_theta_.data(); }
  // Sine of the angle within which a viewport pixel may use this column's sample: the diagonal of the gap to
  // the samples outwards that are `reach` away. A sample farther than this outside every viewport is seen by
  // no pixel.
  const float* margin() const { return margin_.data(); }
  // Per column: the angle between samples, radians: of a square as large as the cell of radius and angle.
  const float* spread() const { return spread_.data(); }
  // Per row, each value four times in a row (packets are 4 columns wide), padded likewise.
  const float* sin_phi4() const { return sin_phi4_.data(); }
  const float* cos_phi4() const { return cos_phi4_.data(); }

 private:
  void divide_circle(int height, double row_off);

  int width_ = 0, height_ = 0, reach_;
  double row_off_ = 0;
  PolarMap map_;
  std::vector<float> sin_theta_, cos_theta_, margin_, spread_, sin_phi4_, cos_phi4_;
};

}  // namespace herr
