#include "server/serve/metrics_page.h"

#include <cstddef>
#include <string>

#include "renderer/foveation/polar_map.h"
#include "server/process/process_load.h"
#include "server/process/version.h"
#include "server/serve/process_numbers.h"
#include "server/serve/prometheus_text.h"
#include "server/serve/serve_json.h"
#include "server/statistics/statistics_rows.h"

namespace herr {
namespace {

void add_frames(PrometheusText& page, const ServeSnapshot& snapshot) {
  const RunStatistics& run = snapshot.run;
  for (const CountRow& row : count_rows()) {
    if (row.metric == nullptr) continue;
    page.family(std::string("herr_") + row.metric + "_total", "counter", row.sentence);
    page.sample(run.*row.total);
  }
  for (const CounterRow& row : counter_rows()) {
    page.family(std::string("herr_") + row.name + "_total", "counter", row.sentence);
    page.sample(run.counters.*row.value);
  }
  page.family("herr_rays_total", "counter", "Rays traced, by kind.");
  for (std::size_t i = 0; i < kRayKinds; ++i) {
    page.sample(run.counters.rays.of_kind[i], {{"kind", name_of(static_cast<RayKind>(i))}});
  }
}

void add_quality(PrometheusText& page, const ServeSnapshot& snapshot) {
  page.family("herr_quality_decisions_total", "counter", "Frames, by why they had their quality.");
  for (std::size_t i = 0; i < kQualityReasons; ++i) {
    page.sample(snapshot.run.reasons[i], {{"reason", name_of(static_cast<QualityReason>(i))}});
  }
  if (snapshot.recent.empty()) return;
  const FrameRecord& newest = snapshot.recent.back().record;
  page.family("herr_polar_width_samples", "gauge",
              "Radial samples per eye of the newest frame, half of the width of --polar.");
  page.sample(std::int64_t{newest.decision.quality.polar_width});
  page.family("herr_polar_height_samples", "gauge", "Angular samples per eye of the newest frame.");
  page.sample(std::int64_t{newest.decision.quality.polar_height});
  page.family("herr_light_samples", "gauge", "Shadow rays per light and hit of the newest frame.");
  page.sample(std::int64_t{newest.decision.quality.light_samples});
  if (!newest.misregistration_arcmin) return;
  page.family("herr_feed_misregistration_radians", "gauge",
              "Angle by which the newest frame shows far surfaces of the camera feed beside their place.");
  page.sample(*newest.misregistration_arcmin / (60 * kDegreesPerRadian));
}

void add_durations(PrometheusText& page, const RunStatistics& run) {
  page.family("herr_frame_duration_seconds", "histogram", "Wall time of rendering one frame.");
  page.histogram(run.frame);
  page.family("herr_frame_cpu_seconds", "histogram",
              "CPU time of the whole process, all threads, during one frame.");
  page.histogram(run.cpu);
  page.family("herr_stage_duration_seconds", "histogram", "Wall time of one stage in one frame.");
  for (std::size_t i = 0; i < kStageCount; ++i) {
    page.histogram(run.stages[i], {{"stage", name_of(static_cast<Stage>(i))}});
  }
  page.family("herr_sample_duration_seconds", "histogram", "Time spent sampling the session before a frame.");
  page.histogram(run.sample);
  page.family("herr_motion_to_photon_seconds", "histogram",
              "Presentation time of a frame less the stamp of the pose used.");
  page.histogram(run.motion_to_photon);
  page.family("herr_input_age_seconds", "histogram", "Age of the newest sample used when a frame began.");
  page.histogram(run.pose_age, {{"stream", "pose"}});
  page.histogram(run.gaze_age, {{"stream", "gaze"}});
  page.histogram(run.camera_age, {{"stream", "camera"}});
}

void add_state(PrometheusText& page, const ServeSnapshot& snapshot) {
  page.family("herr_build_info", "gauge", "Always 1; the label names the version.");
  page.sample(std::int64_t{1}, {{"version", program_version()}});
  page.family("herr_ready", "gauge", "1 while frames are rendered, 0 before the first and while stopping.");
  page.sample(std::int64_t{snapshot.phase == ServePhase::running});
  page.family("herr_session_progress_ratio", "gauge", "Share of the session replayed in this lap.");
  page.sample(session_progress(snapshot));
  page.family("herr_session_laps_total", "counter", "Times that all sessions were replayed.");
  page.sample(snapshot.lap);
  if (snapshot.subject) {
    page.family("herr_display_period_seconds", "gauge", "Time between two display ticks.");
    page.sample(snapshot.subject->range.period_ms() * 1e-3);
  }
}

void add_http(PrometheusText& page, const HttpCounters& http) {
  page.family("herr_http_requests_total", "counter", "Answers sent, by HTTP status.");
  for (const auto& [status, count] : http.requests) page.sample(count, {{"code", std::to_string(status)}});
  page.family("herr_http_rejected_total", "counter",
              "Requests refused before any page was asked, by reason.");
  for (const auto& [reason, count] : http.rejected) page.sample(count, {{"reason", reason}});
}

void add_memory(PrometheusText& page, const ServeSnapshot& snapshot, std::int64_t encoder_bytes) {
  page.family("herr_memory_bytes", "gauge", "What renderer, loaded scene and pictures hold, by part.");
  for (const MemoryEntry& part : served_memory(snapshot, encoder_bytes)) {
    page.sample(part.bytes, {{"part", part.name}});
  }
  const ProcessLoad load = process_load();
  page.family("herr_usable_cores", "gauge", "Cores that the process may use.");
  page.sample(std::int64_t{load.cores});
  if (!load.peak_resident_bytes) return;
  page.family("herr_peak_resident_memory_bytes", "gauge",
              "Most memory of the whole process that was ever resident.");
  page.sample(*load.peak_resident_bytes);
}

void add_process(PrometheusText& page) {
  const std::optional<ProcessNumbers> numbers = read_process_numbers();
  if (!numbers) return;
  page.family("process_cpu_seconds_total", "counter", "CPU time, user and system.");
  page.sample(numbers->cpu_seconds);
  page.family("process_resident_memory_bytes", "gauge", "Resident memory.");
  page.sample(numbers->resident_bytes);
  page.family("process_virtual_memory_bytes", "gauge", "Virtual memory.");
  page.sample(numbers->virtual_bytes);
  page.family("process_open_fds", "gauge", "Open file descriptors.");
  page.sample(numbers->open_descriptors);
  page.family("process_max_fds", "gauge", "Most file descriptors that may be open.");
  page.sample(numbers->most_descriptors);
  page.family("process_start_time_seconds", "gauge", "Start of the process since 1970.");
  page.sample(numbers->start_time_seconds);
}

}  // namespace

std::string metrics_page(const ServeSnapshot& snapshot, const HttpCounters& http,
                         std::int64_t encoder_bytes) {
  PrometheusText page;
  add_state(page, snapshot);
  add_frames(page, snapshot);
  add_quality(page, snapshot);
  add_durations(page, snapshot.run);
  add_http(page, http);
  add_memory(page, snapshot, encoder_bytes);
  add_process(page);
  return page.text();
}

}  // namespace herr
