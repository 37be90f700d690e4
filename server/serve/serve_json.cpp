#include "server/serve/serve_json.h"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "server/process/version.h"
#include "server/results/memory_parts.h"
#include "server/results/summary_json.h"
#include "server/statistics/latency_json.h"
#include "server/statistics/load_json.h"
#include "server/statistics/quality_json.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

double seconds(TimeNs ns) {
  return static_cast<double>(ns) * kSecondsPerNs;
}

// As long as the window, or since the start while that is shorter.
double window_length_s(const ServeSnapshot& snapshot, TimeNs now_ns) {
  return std::max(0.0, seconds(std::min(kWindowNs, now_ns - snapshot.started_ns)));
}

Json window_json(const ServeSnapshot& snapshot, TimeNs now_ns) {
  const RunStatistics window = window_statistics(snapshot.recent, now_ns);
  const double length_s = window_length_s(snapshot, now_ns);
  Json json{{"seconds", length_s}, {"frames", frame_counts_json(window)}};
  json["frames_per_s"] = length_s > 0 ? Json(static_cast<double>(window.frames) / length_s) : Json(nullptr);
  return json;
}

Json optional_json(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json of_eyes_json(const std::array<std::optional<double>, 2>& values) {
  return {{"left", optional_json(values[0])}, {"right", optional_json(values[1])}};
}

Json direction_json(const glm::dvec3& direction) {
  return Json::array({direction.x, direction.y, direction.z});
}

Json statistics_json(const RunStatistics& statistics) {
  Json json = latencies_json(statistics);
  json["load"] = load_json(statistics, process_load());
  json["pace"] = pace_json(statistics);
  json["quality"] = quality_json(statistics);
  json["feed"] = feed_json(statistics);
  return json;
}

// Of the stages, and "sample", the one that is furthest above its median of the run; null: none is above it.
// A wait of threads is none.
Json late_stage_json(const FrameRecord& record, const RunStatistics& run) {
  Json name(nullptr);
  double most_ms = 0;
  const auto see = [&](const char* stage, double ms, const LatencyHistogram& all) {
    const double above_ms = ms - all.quantile_ns(0.5) * 1e-6;
    if (!(above_ms > most_ms)) return;
    most_ms = above_ms;
    name = stage;
  };
  see("sample", record.sample_ms, run.sample);
  for (std::size_t i = 0; i < kStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    if (stage != Stage::idle) see(name_of(stage), record.times.ms[i], run.stages[i]);
  }
  return name;
}

Json frame_json(const RecentFrame& frame, TimeNs started_ns, const RunStatistics& run) {
  const FrameRecord& record = frame.record;
  Json stages = Json::object();
  for (std::size_t i = 0; i < kStageCount; ++i) {
    stages[name_of(static_cast<Stage>(i))] = record.times.ms[i];
  }
  return {
      {"sequence", frame.sequence},
      {"lap", frame.lap},
      {"frame", record.frame},
      {"t_ns", record.t_ns},
      {"finished_s", seconds(frame.finished_ns - started_ns)},
      {"frame_ms", record.times.frame_ms},
      {"period_ms", record.period_ms},
      {"stages_ms", stages},
      {"sample_ms", record.sample_ms},
      {"cpu_ms", optional_json(record.cpu_ms)},
      {"gaze_in_head",
       {{"left", direction_json(record.gaze_in_head[0])}, {"right", direction_json(record.gaze_in_head[1])}}},
      {"preemptions", record.preemptions ? Json(*record.preemptions) : Json(nullptr)},
      {"views_ms", record.times.views_ms},
      {"outside_ms", record.times.outside_ms},
      {"pose_age_ms", optional_json(record.pose_age_ms)},
      {"gaze_age_ms", optional_json(record.gaze_age_ms)},
      {"camera_age_ms", optional_json(record.camera_age_ms)},
      {"motion_to_photon_ms", optional_json(record.motion_to_photon_ms)},
      {"polar_width", record.decision.quality.polar_width},
      {"k_radial_per_deg", of_eyes_json(record.k_radial)},
      {"k_angular_per_deg", of_eyes_json(record.k_angular)},
      {"light_samples", record.decision.quality.light_samples},
      {"allowed_probes", record.decision.quality.probes},
      {"quality_reason", name_of(record.decision.reason)},
      {"quality_aim_ms", optional_json(record.decision.aim_ms)},
      {"quality_predicted_ms", optional_json(record.decision.predicted_ms)},
      {"head_deg_s", record.head_deg_s},
      {"feed_turn_arcmin", optional_json(record.feed_turn_arcmin)},
      {"feed_shift_arcmin", optional_json(record.feed_shift_arcmin)},
      {"misregistration_arcmin", optional_json(record.misregistration_arcmin)},
      {"missed", record.missed},
      {"cause", record.missed ? Json(name_of(record.cause)) : Json(nullptr)},
      {"over_ms", record.missed ? Json(record.over_ms) : Json(nullptr)},
      {"stage", record.missed ? late_stage_json(record, run) : Json(nullptr)},
      {"dropped", record.dropped_frames},
      {"repeated", record.repeated_ticks}};
}

}  // namespace

double session_progress(const ServeSnapshot& snapshot) {
  if (!snapshot.subject || snapshot.rendered == 0) return 0;
  const FrameRange& range = snapshot.subject->range;
  const double done = static_cast<double>(snapshot.frame - range.first + 1);
  return std::clamp(done / static_cast<double>(std::max<std::int64_t>(range.count, 1)), 0.0, 1.0);
}

Json status_json(const ServeSnapshot& snapshot, const ReplayOptions& options, TimeNs now_ns) {
  Json json{{"format_version", 1},
            {"program", program_with_version()},
            {"phase", name_of(snapshot.phase)},
            {"uptime_s", seconds(now_ns - snapshot.started_ns)},
            {"snapshot_age_s", seconds(now_ns - snapshot.taken_ns)},
            {"clock", name_of(options.clock)},
            {"lap", snapshot.lap},
            {"sequence", snapshot.rendered},
            {"run", {{"frames", frame_counts_json(snapshot.run)}}},
            {"window", window_json(snapshot, now_ns)},
            {"definitions", count_definitions_json(options.clock)}};
  json["load"] = load_json(snapshot.run, process_load());
  if (!snapshot.subject) return json;
  const SessionReport& subject = *snapshot.subject;
  json["replay"] = {{"frame", snapshot.rendered > 0 ? Json(snapshot.frame) : Json(nullptr)},
                    {"first_frame", subject.range.first},
                    {"frames", subject.range.count},
                    {"progress", session_progress(snapshot)},
                    {"period_ms", subject.range.period_ms()}};
  json.update(subject_json(subject, options));
  json["warnings"] = subject.warnings;
  return json;
}

Json latency_reply_json(const ServeSnapshot& snapshot, ReplayClock clock, TimeNs now_ns) {
  const RunStatistics window = window_statistics(snapshot.recent, now_ns);
  Json window_part{{"seconds", window_length_s(snapshot, now_ns)}, {"frames", frame_counts_json(window)}};
  window_part.update(statistics_json(window));
  Json run_part{{"seconds", seconds(now_ns - snapshot.started_ns)},
                {"frames", frame_counts_json(snapshot.run)}};
  run_part.update(statistics_json(snapshot.run));
  Json definitions = definitions_json(clock);
  definitions["window"] = "frames that were finished in the last 10 seconds";
  definitions["run"] = "frames since the server was started";
  return {{"format_version", 1}, {"window", window_part}, {"run", run_part}, {"definitions", definitions}};
}

Json frames_json(const ServeSnapshot& snapshot, std::int64_t since, bool missed_only) {
  const std::vector<RecentFrame>& recent = snapshot.recent;
  Json frames = Json::array();
  bool more = false;
  for (const RecentFrame& frame : recent) {
    if (frame.sequence <= since || (missed_only && !frame.record.missed)) continue;
    more = frames.size() == kMostFramesInAnswer;
    if (more) break;
    frames.push_back(frame_json(frame, snapshot.started_ns, snapshot.run));
  }
  return {{"format_version", 1},
          {"oldest", recent.empty() ? Json(nullptr) : Json(recent.front().sequence)},
          {"newest", recent.empty() ? Json(nullptr) : Json(recent.back().sequence)},
          {"more", more},
          {"frames", frames}};
}

MemoryUse served_memory(const ServeSnapshot& snapshot, std::int64_t encoder_bytes) {
  MemoryUse parts = snapshot.memory;
  set_encoder_bytes(encoder_bytes, parts);
  return parts;
}

Json plan_reply_json(const ServeSnapshot& snapshot, std::int64_t encoder_bytes) {
  return {{"format_version", 1},
          {"session", snapshot.subject ? Json(snapshot.subject->name) : Json(nullptr)},
          {"plan", snapshot.subject ? plan_json(snapshot.subject->plan) : Json::array()},
          {"memory_bytes",
           snapshot.subject ? memory_json(served_memory(snapshot, encoder_bytes)) : Json::object()},
          {"probes", snapshot.run.frames > 0 && snapshot.subject && snapshot.subject->plan.probes
                         ? probes_json(snapshot.run)
                         : Json()}};
}

}  // namespace herr
