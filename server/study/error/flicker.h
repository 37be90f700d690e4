// How pictures change from one frame to the next while the gaze rests. Before: a clip of frames and their
// references. After: a table beside the errors of single pictures, which cannot see it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "server/study/error/linear_picture.h"
#include "server/study/error/viewport_map.h"

namespace herr {

// By band; NaN where a band has no pixel.
struct Flicker {
  std::array<double, kBands> test;       // RMS of each pixel's change from frame to frame
  std::array<double, kBands> reference;  // the same of the references: what the motion alone makes
  std::array<double, kBands> excess;     // RMS of the difference of both changes
};

// Takes a clip frame by frame. Not thread-safe.
class FlickerSum {
 public:
  // `maps`: of this frame. Pixels count that are seen in this frame and were in the last. Throws
  // std::invalid_argument for other numbers or sizes than those of the maps and of the frame before.
  void add(std::span<const ViewportMap> maps, std::vector<LinearPicture> test,
           std::vector<LinearPicture> reference);
  // None before two frames.
  std::optional<Flicker> flicker() const;

 private:
  struct Sum {
    double test = 0, reference = 0, excess = 0, count = 0;
  };
  void add_row(const ViewportMap& map, std::size_t viewport, std::size_t y, const LinearPicture& test,
               const LinearPicture& reference);

  std::vector<LinearPicture> last_test_, last_reference_;
  std::vector<std::vector<std::uint8_t>> last_band_;
  std::array<Sum, kBands> sums_{};
  int frames_ = 0;
};

}  // namespace herr
