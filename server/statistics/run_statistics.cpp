#include "server/statistics/run_statistics.h"

#include <cstddef>

namespace herr {
namespace {

void add_if(LatencyHistogram& histogram, const std::optional<double>& value_ms) {
  if (value_ms) histogram.add_ms(*value_ms);
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
  polar_width.add_ms(record.decision.quality.polar_width);
  light_samples.add_ms(record.decision.quality.light_samples);
  head_deg_s.add_ms(record.head_deg_s);
  add_if(feed_turn, record.feed_turn_arcmin);
  add_if(feed_shift, record.feed_shift_arcmin);
  add_if(misregistration, record.misregistration_arcmin);
  ++reasons[static_cast<std::size_t>(record.decision.reason)];
  stutter.add_ms(record.times.frame_ms);
  counters += record.counters;
  probes = record.probes;
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
  polar_width.merge(other.polar_width);
  light_samples.merge(other.light_samples);
  head_deg_s.merge(other.head_deg_s);
  feed_turn.merge(other.feed_turn);
  feed_shift.merge(other.feed_shift);
  misregistration.merge(other.misregistration);
  for (std::size_t i = 0; i < kQualityReasons; ++i) reasons[i] += other.reasons[i];
  stutter.merge(other.stutter);
  counters += other.counters;
  if (other.frames > 0) probes = other.probes;
  frames += other.frames;
  missed_frames += other.missed_frames;
  nonfinite_pictures += other.nonfinite_pictures;
  dropped_frames += other.dropped_frames;
  repeated_ticks += other.repeated_ticks;
}

}  // namespace herr
