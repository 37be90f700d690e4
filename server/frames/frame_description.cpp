#include "server/frames/frame_description.h"

#include <algorithm>

#include "renderer/foveation/reached_acuity.h"
#include "server/frames/feed_registration.h"
#include "server/quality/motion_policy.h"

namespace herr {
namespace {

constexpr double kMsPerNs = 1e-6;

// A negative age says that the value was interpolated: its age has no meaning.
std::optional<double> age_ms(TimeNs age_ns) {
  if (age_ns < 0) return std::nullopt;
  return static_cast<double>(age_ns) * kMsPerNs;
}

// The older one where the eyes have cameras of their own.
std::optional<double> camera_age_ms(const FrameSample& sample) {
  std::optional<double> oldest;
  for (const auto& camera : sample.cameras) {
    if (!camera) continue;
    const std::optional<double> age = age_ms(camera->age_ns);
    if (age && (!oldest || *age > *oldest)) oldest = age;
  }
  return oldest;
}

void describe_acuity(const RenderedFrame& rendered, FrameRecord& record) {
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const double theta_max_deg = rendered.theta_max_deg[eye];
    if (rendered.polar_width[eye] == 0 || !(theta_max_deg > 0)) continue;
    const ReachedAcuity reached =
        reached_acuity(theta_max_deg, rendered.polar_width[eye], rendered.polar_height);
    record.k_radial[eye] = reached.k_radial;
    record.k_angular[eye] = reached.k_angular;
    record.k_angular_at_deg[eye] = reached.k_angular_at_deg;
  }
}

void describe_feed(const FrameSample& sample, const SessionReport& report, FrameRecord& record) {
  if (!report.plan.camera) return;
  const auto feed = feed_registration(sample, report.header.cameras,
                                      report.settings.feed_distance_m.value_or(kUsualFeedDistance_m));
  if (!feed) return;
  record.feed_turn_arcmin = feed->turn_arcmin;
  record.feed_shift_arcmin = feed->shift_arcmin;
  record.misregistration_arcmin = feed->misregistration_arcmin;
}

}  // namespace

FrameRecord describe_frame(std::int64_t frame, const FrameSample& sample, const RenderedFrame& rendered,
                           const SessionReport& report, ReplayClock clock) {
  FrameRecord record;
  record.frame = frame;
  record.t_ns = sample.t_ns;
  record.times = rendered.times;
  record.counters = rendered.counters;
  record.probes = rendered.probes;
  record.theta_max_deg = rendered.theta_max_deg;
  record.cpu_ms = rendered.cpu_ms;
  record.preemptions = rendered.preemptions;
  describe_acuity(rendered, record);
  record.pose_source = sample.head.source;
  record.gaze_source = sample.gaze.source;
  record.gaze_in_head = sample.gaze.head_direction;
  record.pose_age_ms = age_ms(sample.head.age_ns);
  if (report.findings.gaze_rows > 0) record.gaze_age_ms = age_ms(sample.gaze.age_ns);
  record.camera_age_ms = camera_age_ms(sample);
  describe_feed(sample, report, record);
  const double frame_ms = rendered.times.frame_ms;
  const double period_ms = report.range.period_ms();
  record.period_ms = period_ms;
  record.missed = frame_ms > period_ms;
  const double shown_after_ms = clock == ReplayClock::max ? frame_ms : std::max(frame_ms, period_ms);
  if (record.pose_age_ms) record.motion_to_photon_ms = *record.pose_age_ms + shown_after_ms;
  return record;
}

void describe_quality(const QualityDecision& decision, const FrameSample& sample, FrameRecord& record) {
  record.decision = decision;
  record.head_deg_s = motion_deg_s(sample.head_speed);
}

void describe_pacing(const FramePacer::Outcome& outcome, std::int64_t dropped, FrameRecord& record) {
  record.missed = outcome.missed;
  record.dropped_frames = dropped;
  record.repeated_ticks = outcome.repeated;
  if (record.pose_age_ms) record.motion_to_photon_ms = *record.pose_age_ms + outcome.shown_after_ms;
}

}  // namespace herr
