// The head's pose at any time, from the pose stream, in memory that does not depend on its length.
// Before: RowStream<PoseRow>. After: Session::sample. The modes are described in this folder's README.md.
#pragma once

#include <optional>

#include "sessions/format/pose.h"
#include "sessions/streams/head_speed.h"
#include "sessions/streams/row_stream.h"
#include "sessions/streams/session_options.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

// Further apart than this, two samples say nothing about what lay between them or where the head was going.
inline constexpr TimeNs kMaxPoseGapNs = 1'000'000'000;
// Closer than this (10 kHz), their difference is the clock's jitter, not a velocity.
inline constexpr TimeNs kMinPoseStepNs = 100'000;

class PoseSampler {
 public:
  // Reads the first rows; throws InputError when there is none.
  PoseSampler(RowStream<PoseRow> rows, SamplingMode mode, double predict_cap_s);
  // Times must not decrease. Before the first sample: the first sample, held, with age 0.
  SampledPose at(TimeNs t_ns);
  // How fast the head moved up to the newest pose at or before the time of the last at().
  const HeadSpeed& speed() const { return speed_.speed(); }

 private:
  void advance(TimeNs t_ns);
  SampledPose interpolated(TimeNs t_ns) const;
  SampledPose predicted(TimeNs t_ns) const;
  SampledPose newest(TimeNs t_ns) const;

  RowStream<PoseRow> rows_;
  SamplingMode mode_;
  double predict_cap_s_;
  HeadSpeedMeter speed_;
  std::optional<PoseRow> before_;  // last but one at or before the time
  PoseRow newest_;                 // newest at or before the time
  std::optional<PoseRow> after_;   // first after the time
};

}  // namespace herr
