// A whole run in constant memory: latency stage by stage, quality, counts. Merging is exact: the statistics
// of runs, merged in any order, are those of all their frames, but for `probes`, which is of one run alone.
// What there is, and how it adds, stands in statistics_rows.h.
// Before: one FrameRecord per frame. After: latency_table, summary_json.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "renderer/frame_counters.h"
#include "renderer/stage_times.h"
#include "server/statistics/frame_record.h"
#include "server/statistics/latency_histogram.h"

namespace herr {

// Not thread-safe.
struct RunStatistics {
  std::array<LatencyHistogram, kStageCount> stages;
  LatencyHistogram frame, sample, views, outside, write, wait, cpu;
  LatencyHistogram pose_age, gaze_age, camera_age, motion_to_photon;
  // Their "milliseconds" are columns, rows, light samples, probes, degrees per second, samples per degree and
  // arc minutes.
  LatencyHistogram polar_width, polar_height, light_samples, allowed_probes, head_deg_s;
  LatencyHistogram k_radial, k_angular;
  LatencyHistogram feed_turn, feed_shift, misregistration;
  std::array<std::int64_t, kQualityReasons> reasons{};  // frames by why they had their quality
  FrameCounters counters;                               // totals
  std::optional<ProbeCounts> probes;                    // of the newest frame; none once two runs were merged
  std::int64_t frames = 0, missed_frames = 0, nonfinite_pictures = 0;
  std::int64_t over_target = 0;                         // --target-ms
  std::int64_t floor_over_target = 0;                   // of these, at a policy's floor
  std::int64_t dropped_frames = 0, repeated_ticks = 0;  // realtime only
  std::int64_t stutter_frames = 0, stutter_ns = 0;
  std::int64_t missed_by_machine = 0, missed_by_work = 0, missed_by_both = 0;  // miss_cause.h
  std::int64_t preemptions = 0, clipped_pixels = 0;

  void add(const FrameRecord& record);
  void merge(const RunStatistics& other);

  double stutter_share_of_time() const;  // 0 ... 1; 0 when no time has passed
};

}  // namespace herr
