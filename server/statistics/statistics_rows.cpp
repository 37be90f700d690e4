#include "server/statistics/statistics_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace herr {
namespace {

using Group = DistributionGroup;
using Record = FrameRecord;
using Run = RunStatistics;
using Value = std::optional<double>;

constexpr Value lesser(const std::array<Value, 2>& of_eyes) {
  if (!of_eyes[0] || !of_eyes[1]) return of_eyes[0] ? of_eyes[0] : of_eyes[1];
  return std::min(*of_eyes[0], *of_eyes[1]);
}

constexpr std::array kDistributions{
    DistributionRow{"frame", "ms", Group::latency,
                    "wall time of rendering one frame, encoding and writing excluded; the sum of its stages",
                    &Run::frame, [](const Record& r) -> Value { return r.times.frame_ms; }},
    DistributionRow{"sample", "ms", Group::latency,
                    "time spent sampling the session, camera images decoded, before the frame", &Run::sample,
                    [](const Record& r) -> Value { return r.sample_ms; }},
    DistributionRow{"views", "ms", Group::latency,
                    "wall time of making the further views, where there are any, after the frame",
                    &Run::views,
                    [](const Record& r) -> Value {
                      if (!(r.times.views_ms > 0)) return std::nullopt;
                      return r.times.views_ms;
                    }},
    DistributionRow{"outside", "ms", Group::latency,
                    "of the further views: wall time of the view from outside, where there is one",
                    &Run::outside,
                    [](const Record& r) -> Value {
                      if (!(r.times.outside_ms > 0)) return std::nullopt;
                      return r.times.outside_ms;
                    }},
    DistributionRow{"write", "ms", Group::latency,
                    "wall time of encoding one frame's pictures on the render threads, after the frame",
                    &Run::write, [](const Record& r) -> Value { return r.write_ms; }},
    DistributionRow{"wait", "ms", Group::latency,
                    "time spent waiting for room in the writer's queue, after the frame", &Run::wait,
                    [](const Record& r) -> Value { return r.wait_ms; }},
    DistributionRow{"motion_to_photon", "ms", Group::latency,
                    "presentation time - stamp of the newest pose used", &Run::motion_to_photon,
                    [](const Record& r) { return r.motion_to_photon_ms; }},
    DistributionRow{"pose_age", "ms", Group::latency,
                    "frame start - stamp of the newest pose used; likewise gaze_age, camera_age",
                    &Run::pose_age, [](const Record& r) { return r.pose_age_ms; }},
    DistributionRow{"gaze_age", "ms", Group::latency, "frame start - stamp of the newest gaze used",
                    &Run::gaze_age, [](const Record& r) { return r.gaze_age_ms; }},
    DistributionRow{"camera_age", "ms", Group::latency,
                    "frame start - stamp of the newest camera image used; of the older one of two",
                    &Run::camera_age, [](const Record& r) { return r.camera_age_ms; }},
    DistributionRow{
        "cpu", "ms", Group::load,
        "CPU time of the whole process, all threads, during the frame time; writers, encoders and "
        "HTTP replies that ran beside the frame are in it",
        &Run::cpu, [](const Record& r) { return r.cpu_ms; }},
    DistributionRow{
        "polar_width", "samples", Group::quality,
        "radial samples per eye that a frame traced, half of the width of --polar; light_samples: for each "
        "light and hit",
        &Run::polar_width, [](const Record& r) -> Value { return double(r.decision.quality.polar_width); }},
    DistributionRow{"polar_height", "samples", Group::quality,
                    "angular samples that a frame traced: rows of the polar buffers", &Run::polar_height,
                    [](const Record& r) -> Value { return double(r.decision.quality.polar_height); }},
    DistributionRow{"light_samples", "samples", Group::quality, "shadow rays for each light and hit",
                    &Run::light_samples,
                    [](const Record& r) -> Value { return double(r.decision.quality.light_samples); }},
    DistributionRow{"allowed_probes", "probes", Group::quality,
                    "probes that a frame could update at most; 0 without probes", &Run::allowed_probes,
                    [](const Record& r) -> Value { return double(r.decision.quality.probes); }},
    DistributionRow{
        "head_deg_s", "degrees per second", Group::quality,
        "recorded turn of the head plus its way seen from 2 m, smoothed over 20 ms, falling off with 0.25 s",
        &Run::head_deg_s, [](const Record& r) -> Value { return r.head_deg_s; }},
    DistributionRow{"k_radial", "samples per degree", Group::quality,
                    "radial samples per degree of eccentricity theta, times theta + 1: the same everywhere "
                    "in a frame; the "
                    "acuity function 200 / (theta + 1) asks for 200; the eye that has less",
                    &Run::k_radial, [](const Record& r) { return lesser(r.k_radial); }},
    DistributionRow{"k_angular", "samples per degree", Group::quality,
                    "samples per degree around the circle of eccentricity theta, times theta + 1: the least "
                    "of all circles "
                    "on the display, near 21 degrees; 200 is asked for; the eye that has less",
                    &Run::k_angular, [](const Record& r) { return lesser(r.k_angular); }},
    DistributionRow{
        "misregistration", "arcmin", Group::feed,
        "angle between where a pixel of the feed is shown and where its surface truly is, for a far surface: "
        "asin(b / D), b = distance from the eye, by the pose used, to the camera at exposure, D = the feed's "
        "distance; at distance d it is |asin(b / D) - asin(b / d)|; the worse eye",
        &Run::misregistration, [](const Record& r) { return r.misregistration_arcmin; }},
    DistributionRow{
        "feed_turn", "arcmin", Group::feed,
        "angle that the camera turned between exposure and the pose used; re-projection undoes it",
        &Run::feed_turn, [](const Record& r) { return r.feed_turn_arcmin; }},
    DistributionRow{"feed_shift", "arcmin", Group::feed,
                    "asin(m / D), m = distance that the camera moved between exposure and the pose used",
                    &Run::feed_shift, [](const Record& r) { return r.feed_shift_arcmin; }}};

constexpr std::array kCounts{
    CountRow{"rendered", "frames_rendered", "frames", "Frames rendered since the start.", &Run::frames,
             [](const Record&) -> std::int64_t { return 1; }},
    CountRow{"missed", "frames_missed_deadline", "frames", "Frames that took longer than a display period.",
             &Run::missed_frames, [](const Record& r) -> std::int64_t { return r.missed ? 1 : 0; }},
    CountRow{"over_target", "frames_over_target", "frames",
             "Frames that took longer than --target-ms, or than a display period without it.",
             &Run::over_target, [](const Record& r) -> std::int64_t { return r.over_target ? 1 : 0; }},
    CountRow{
        "floor_over_target", nullptr, "frames",
        "Of these, frames that had the least quality that the policy deadline may give.",
        &Run::floor_over_target,
        [](const Record& r) -> std::int64_t { return r.over_target && is_floor(r.decision.reason) ? 1 : 0; }},
    CountRow{"dropped", "frames_dropped", "frames",
             "Frames of the session that were never rendered because a newer one was due.",
             &Run::dropped_frames, [](const Record& r) { return r.dropped_frames; }},
    CountRow{"repeated", "display_ticks_repeated", "ticks", "Display ticks that had no new frame.",
             &Run::repeated_ticks, [](const Record& r) { return r.repeated_ticks; }},
    CountRow{"nonfinite_picture_values", nullptr, "values", "NaN or Inf values that reached an encoder.",
             &Run::nonfinite_pictures, [](const Record& r) { return r.nonfinite_pictures; }},
    CountRow{"stutter_frames", nullptr, "frames", "Frames that stuttered, as their own run saw them.",
             &Run::stutter_frames, [](const Record& r) -> std::int64_t { return r.stutter ? 1 : 0; }},
    CountRow{
        "stutter_ns", nullptr, "ns", "Frame time of the frames that stuttered.", &Run::stutter_ns,
        [](const Record& r) -> std::int64_t { return r.stutter ? std::llround(r.times.frame_ms * 1e6) : 0; }},
    CountRow{"missed_by_machine", "frames_missed_by_machine", "frames",
             "Of the missed frames, those whose work would have fit, had the cores not been taken away.",
             &Run::missed_by_machine,
             [](const Record& r) -> std::int64_t { return r.cause == MissCause::machine ? 1 : 0; }},
    CountRow{"missed_by_work", "frames_missed_by_work", "frames",
             "Of the missed frames, those that had the cores and did not fit.", &Run::missed_by_work,
             [](const Record& r) -> std::int64_t { return r.cause == MissCause::work ? 1 : 0; }},
    CountRow{
        "missed_by_both", "frames_missed_by_both", "frames",
        "Of the missed frames, those from which cores were taken away and whose work would not have fit.",
        &Run::missed_by_both,
        [](const Record& r) -> std::int64_t { return r.cause == MissCause::both ? 1 : 0; }},
    CountRow{"preemptions", "frame_preemptions", "preemptions",
             "Times that a thread of the process lost its core to another one during a frame.",
             &Run::preemptions, [](const Record& r) { return r.preemptions.value_or(0); }},
    CountRow{"clipped_pixels", nullptr, "pixels",
             "Pixels of PNG files brighter than white or below 0, which they cannot show.",
             &Run::clipped_pixels, [](const Record& r) { return r.clipped_pixels; }}};

static_assert(sizeof(Run) == sizeof(Run::stages) + kDistributions.size() * sizeof(LatencyHistogram) +
                                 sizeof(Run::reasons) + sizeof(FrameCounters) +
                                 sizeof(std::optional<ProbeCounts>) + kCounts.size() * sizeof(std::int64_t),
              "everything has a row");

}  // namespace

std::span<const DistributionRow> distribution_rows() {
  return kDistributions;
}

std::span<const CountRow> count_rows() {
  return kCounts;
}

}  // namespace herr
