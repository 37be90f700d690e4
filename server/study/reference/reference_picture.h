// A reference that states its own error: the mean of two halves of different seeds. Half the RMS of what they
// differ by is the error of their mean, for each metric and band. Before: reference_spec, an instant. After:
// every error of a study is measured against one.
#pragma once

#include <functional>
#include <vector>

#include "server/study/error/linear_picture.h"
#include "server/study/error/metrics.h"
#include "server/study/reference/frame_instant.h"
#include "server/study/reference/reference_spec.h"

namespace herr {

// A half is a mean of passes, kept in half floats: what a cached one holds is what a fresh one holds.
struct ReferenceHalves {
  std::vector<LinearPicture> half[2];  // by viewport, as they are: not limited
  int passes = 0, most_passes = 0;     // of each half: where the fewest and the most were taken
  bool goal_met = false;
  double seconds = 0;  // that they took
};

struct ReferencePicture {
  ReferenceSpec spec;
  std::vector<LinearPicture> picture;  // by viewport, limited to white
  ErrorTable error;                    // its own
  int passes = 0, most_passes = 0;
  bool goal_met = false;
  bool found = false;  // on disk, not rendered now
  double seconds = 0;
};

// Passes over pixels go on until the acuity-weighted error of the mean is 1/5 of that of spec.finest (less
// its own share), there are 512, or `out_of_time` says so, from the third pass on, or `one_pass` after the
// first (asked with the seconds since the start, and those of the pass in both halves); after spec.passes
// only in tiles where the halves differ. Where time ended these first passes the goal counts as missed, and
// spec.finest is not rendered. Without spec.refined, and of seeds, they are spec.passes.
ReferenceHalves render_halves(const ReferenceSpec& spec, const FrameInstant& instant,
                              const std::function<bool()>& out_of_time,
                              const std::function<bool(double so_far_s, double pass_s)>& one_pass = {});

// `parallel_for`: for measuring.
ReferencePicture mean_of_halves(const ReferenceSpec& spec, const FrameInstant& instant,
                                ReferenceHalves halves, const ParallelFor& parallel_for);

}  // namespace herr
