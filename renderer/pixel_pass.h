// A frame that is one of many whose mean is wanted: other random numbers, rays through another place of each
// pixel, and only the tiles that need it. Means of such frames are references for errors.
// Before: whoever averages. After: Renderer::render_pass.
#pragma once

#include <cstdint>
#include <span>

namespace herr {

// Rays that are traced together, a square of a viewport: columns [x0, x1), rows [y0, y1) of its rays, which
// at scale 1 are its pixels.
struct PixelTile {
  int viewport = 0;
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// A place in the cell of a polar sample, in columns and rows off its middle, [-1/2, 1/2].
struct CellPlace {
  double column = 0, row = 0;
};

struct PixelPass {
  std::uint32_t seed = 0;  // in place of the settings'
  // Without foveation: the ray of a pixel passes through its place number `index` of a sequence that fills
  // the pixel evenly (R2: Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018), shifted
  // by a random vector of the pixel and `sequence`. The mean over indices is the pixel under a box filter,
  // for any number of them (each place is uniform).
  bool jitter = false;
  std::uint32_t sequence = 0;
  int index = 0;
  // With foveation: rays pass through this place of each polar cell.
  CellPlace cell;
  // Which of Renderer::pixel_tiles() to trace, one byte each, 0: not; the pixels of those hold nothing of
  // use. Empty: all.
  std::span<const std::uint8_t> tiles;
};

}  // namespace herr
