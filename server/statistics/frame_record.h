// What is known of one replayed frame besides its pictures: one row of frames.csv, one sample of every
// statistic. Before: the replay loop fills it. After: frames_csv, RunStatistics.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "renderer/frame_counters.h"
#include "renderer/probe_counts.h"
#include "renderer/stage_times.h"
#include "server/quality/quality_policy.h"
#include "server/statistics/miss_cause.h"
#include "sessions/format/pose.h"

namespace herr {

struct FrameRecord {
  std::int64_t frame = 0;  // number in the session: its time is start + frame / display_hz
  TimeNs t_ns = 0;         // stamp of the frame on the session's clock
  StageTimes times;
  FrameCounters counters;
  ProbeCounts probes;
  double sample_ms = 0;  // sampling the session, decoding a camera image included; before the frame time
  double write_ms = 0;   // encoding, on the render threads, outside the frame time
  double wait_ms = 0;    // waiting for room in the writer's queue
  // CPU time of all threads of the process during the frame time; none where the kernel does not tell.
  std::optional<double> cpu_ms;
  // How often one of them lost its core to somebody else meanwhile (cpu_use.h); none likewise.
  std::optional<std::int64_t> preemptions;
  // Sampling time minus stamp of the newest sample used; none where a stream is absent or interpolated.
  std::optional<double> pose_age_ms, gaze_age_ms, camera_age_ms;
  // Presentation time minus stamp of the pose used; none when the pose was interpolated.
  std::optional<double> motion_to_photon_ms;
  SampleSource pose_source = SampleSource::held;
  std::array<SampleSource, 2> gaze_source{SampleSource::held, SampleSource::held};
  // Unit vectors of the head's space, -Z ahead: where each eye's fovea was taken to look in this frame.
  std::array<glm::dvec3, 2> gaze_in_head{glm::dvec3{0, 0, -1}, glm::dvec3{0, 0, -1}};
  std::array<double, 2> theta_max_deg{};
  // Per eye, as reached_acuity() has them; none without polar buffers, and of an eye without viewports.
  std::array<std::optional<double>, 2> k_radial, k_angular, k_angular_at_deg;
  QualityDecision decision;  // which quality the frame had, and why
  double head_deg_s = 0;     // how fast the head moved (motion_policy.h)
  // How well feed and virtual objects agree (feed_registration.h); none without a feed.
  std::optional<double> feed_turn_arcmin, feed_shift_arcmin, misregistration_arcmin;
  double period_ms = 0;  // of the display: what a frame may take
  bool missed = false;   // the frame time exceeds the display period; realtime: sampling and delays included
  MissCause cause = MissCause::none;  // why it missed (miss_cause.h)
  double over_ms = 0;                 // by how much it did; 0 in time
  bool over_target = false;           // the same time exceeds --target-ms, or the display period without it
  bool stutter = false;             // it took much longer than the frames before it in its run (frame_pace.h)
  std::int64_t dropped_frames = 0;  // realtime: frames of the session left out just before this one
  std::int64_t repeated_ticks = 0;  // realtime: display ticks before this frame that showed nothing new
  std::int64_t nonfinite_pictures = 0;  // NaN or Inf values that reached an encoder
  std::int64_t clipped_pixels = 0;  // of PNG files: brighter than white or below 0, which they cannot show
};

}  // namespace herr
