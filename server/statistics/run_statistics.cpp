#include "server/statistics/run_statistics.h"

#include <cstddef>

namespace herr {
namespace {

void add_if(LatencyHistogram& histogram, const std::optional<double>& value_ms) {
  if (value_ms) histogram.add_ms(*value_ms);
}

void add_counters(FrameCounters& total, const FrameCounters& frame) {
  total.primary_rays += frame.primary_rays;
  total.shadow_rays += frame.shadow_rays;
  total.catcher_shadow_rays += frame.catcher_shadow_rays;
  total.mirror_rays += frame.mirror_rays;
  total.mirror_shadow_rays += frame.mirror_shadow_rays;
  total.polar_samples += frame.polar_samples;
  total.viewport_pixels += frame.viewport_pixels;
  total.invalid_rays += frame.invalid_rays;
  total.nonfinite_values += frame.nonfinite_values;
  total.commits += frame.commits;
}

}  // namespace

void RunStatistics::add(const FrameRecord& record) {
  for (std::size_t i = 0; i < kStageCount; ++i) stages[i].add_ms(record.times.ms[i]);
  frame.add_ms(record.times.frame_ms);
  sample.add_ms(record.sample_ms);
  write.add_ms(record.write_ms);
  wait.add_ms(record.wait_ms);
  add_if(pose_age, record.pose_age_ms);
  add_if(gaze_age, record.gaze_age_ms);
  add_if(camera_age, record.camera_age_ms);
  add_if(motion_to_photon, record.motion_to_photon_ms);
  add_counters(counters, record.counters);
  ++frames;
  missed_frames += record.missed ? 1 : 0;
  nonfinite_pictures += record.nonfinite_pictures;
  dropped_frames += record.dropped_frames;
  repeated_ticks += record.repeated_ticks;
}

void RunStatistics::merge(const RunStatistics& other) {
  for (std::size_t i = 0; i < kStageCount; ++i) stages[i].merge(other.stages[i]);
  frame.merge(other.frame);
  sample.merge(other.sample);
  write.merge(other.write);
  wait.merge(other.wait);
  pose_age.merge(other.pose_age);
  gaze_age.merge(other.gaze_age);
  camera_age.merge(other.camera_age);
  motion_to_photon.merge(other.motion_to_photon);
  add_counters(counters, other.counters);
  frames += other.frames;
  missed_frames += other.missed_frames;
  nonfinite_pictures += other.nonfinite_pictures;
  dropped_frames += other.dropped_frames;
  repeated_ticks += other.repeated_ticks;
}

}  // namespace herr
