// Quality from head motion alone (paper, sections 3.2 and 3.3): wide and soft while the head rests, narrow
// and hard while it moves fast. A pure function of recorded poses. Before: FrameSample::head_speed. After:
// QualityController.
#pragma once

#include "server/quality/quality_policy.h"

namespace herr {

struct MotionConfig {
  // Of twelve recordings of people, with their gaze (README.md): up to the first, which is the 99th
  // percentile while they look at something and the 1st while they turn away, a frame has everything; from
  // the second, the median while they turn away, it has the least; between the two by the speed's logarithm.
  double still_deg_s = 35;
  double fast_deg_s = 95;
  double narrow_share = 0.4;  // width while the head is fast, as a share of the full one
  // Metres moved count as the angle under which they are seen from here: of a person in a room, whatever the
  // size of the scene.
  double seen_from_m = 2;
};

// One number for how fast what is seen moves: the turn, and the way seen from a distance.
double motion_deg_s(const HeadSpeed& motion, const MotionConfig& config = {});

// 0 at rest, 1 when fast.
double motion_share(double deg_s, const MotionConfig& config = {});

// Width full * narrow_share^x and light samples N^(1 - x), the latter as a power of two below N.
// Probes, which carry what they gather from frame to frame, stay as they are.
QualityDecision quality_for_motion(const HeadSpeed& motion, const QualityLimits& limits,
                                   const MotionConfig& config = {});

}  // namespace herr
