// How far apart neighbouring stamps of a stream usually are, from its first rows: the usual step, and whether
// stamps of several cameras alternate in one table.
// Before: stamp_survey collects the first stamps. After: stamp_runs cuts at steps that are far from usual.
#pragma once

#include <span>

#include "sessions/format/pose.h"

namespace herr {

struct StepPattern {
  double usual_ns = 0;  // median of the positive steps; of several cameras, of those from group to group
  // Stamps come in groups of up to `cameras`, much closer to each other than the groups are; 0: they do not.
  int cameras = 0;
  double within_ns = 0;      // median step within a group
  TimeNs thin_below_ns = 0;  // tells a group's stamps from the next group's
};

StepPattern step_pattern(std::span<const TimeNs> stamps);

// A smaller share of close steps is jitter, not a second camera.
inline constexpr double kCloseShare = 0.3;

}  // namespace herr
