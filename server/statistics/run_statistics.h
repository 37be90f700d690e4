// Latency of a whole run, stage by stage, in constant memory; runs merge exactly.
// Before: one FrameRecord per frame. After: latency_table, summary_json.
#pragma once

#include <array>
#include <cstdint>

#include "renderer/stage_times.h"
#include "server/statistics/frame_pace.h"
#include "server/statistics/frame_record.h"
#include "server/statistics/latency_histogram.h"

namespace herr {

struct RunStatistics {
  std::array<LatencyHistogram, kStageCount> stages;
  LatencyHistogram frame, sample, write, wait;
  LatencyHistogram pose_age, gaze_age, camera_age, motion_to_photon;
  // Their "milliseconds" are columns, light samples, degrees per second and arc minutes.
  LatencyHistogram polar_width, light_samples, head_deg_s;
  LatencyHistogram feed_turn, feed_shift, misregistration;
  std::array<std::int64_t, kQualityReasons> reasons{};  // frames by why they had their quality
  Stutter stutter;
  FrameCounters counters;  // totals
  ProbeCounts probes;      // of the last frame
  std::int64_t frames = 0, missed_frames = 0, nonfinite_pictures = 0;
  std::int64_t dropped_frames = 0, repeated_ticks = 0;  // realtime only

  void add(const FrameRecord& record);
  void merge(const RunStatistics& other);
};

}  // namespace herr
