#include "server/results/summary_json.h"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "server/process/version.h"
#include "server/results/settings_report.h"
#include "server/settings/quality_target.h"
#include "server/statistics/latency_json.h"
#include "server/statistics/load_json.h"
#include "server/statistics/quality_json.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

Json session_json(const SessionReport& report) {
  const SessionFindings& findings = report.findings;
  return {{"name", report.name},
          {"title", report.header.name},
          {"folder", report.session_folder.string()},
          {"pose_rows", findings.pose_rows},
          {"gaze_rows", findings.gaze_rows},
          {"event_rows", findings.event_rows},
          {"camera_rows", findings.camera_rows},
          {"skipped_rows", findings.skipped_rows},
          {"skipped_images", findings.skipped_images},
          {"sanitised_camera_values", report.sanitised_camera_values},
          {"truncated", findings.truncated}};
}

Json profile_json(const DisplayProfile& profile) {
  Json viewports = Json::array();
  for (const Viewport& viewport : profile.viewports) {
    viewports.push_back({{"name", viewport.name},
                         {"width_px", viewport.width_px},
                         {"height_px", viewport.height_px},
                         {"kind", viewport.focus ? "focus" : "context"}});
  }
  return {{"name", profile.name}, {"display_hz", profile.display_hz}, {"viewports", viewports}};
}

// Pictures of a frame beside the viewports.
Json further_views_json(const SessionReport& report) {
  Json views = Json::array();
  for (const PictureOutline& view : further_views(report.profile, report.settings)) {
    const Json eye = view.eye ? Json(*view.eye == Eye::left ? "left" : "right") : Json(nullptr);
    views.push_back({{"name", view.name},
                     {"width_px", view.width_px},
                     {"height_px", view.height_px},
                     {"kind", name_of(view.kind)},
                     {"eye", eye}});
  }
  return views;
}

}  // namespace

const char* name_of(ReplayState state) {
  switch (state) {
    case ReplayState::done:
      return "done";
    case ReplayState::interrupted:
      return "interrupted";
    case ReplayState::failed:
      return "failed";
  }
  return "unknown";
}

Json probes_json(const RunStatistics& run) {
  // After a merge nobody knows the newest frame; before the first there is none.
  if (!run.probes && run.frames > 0) return nullptr;
  const ProbeCounts probes = run.probes.value_or(ProbeCounts());
  const RayCounts& all = run.counters.rays;
  const std::int64_t rays = all[RayKind::probe] + all[RayKind::probe_shadow] + all[RayKind::catcher_probe] +
                            all[RayKind::catcher_probe_shadow];
  return {
      {"active", probes.active},          {"relocated", probes.relocated},
      {"inactive", probes.inactive},      {"updated_per_frame", probes.updated},
      {"reacting", probes.reacting},      {"rays_per_frame", rays / std::max<std::int64_t>(run.frames, 1)},
      {"variability", probes.variability}};
}

Json plan_json(const FramePlan& plan) {
  Json entries = Json::array();
  for (const PlanEntry& entry : plan.entries) {
    entries.push_back({{"name", entry.name}, {"runs", entry.runs}, {"reason", entry.reason}});
  }
  return entries;
}

Json memory_json(const MemoryUse& use) {
  Json json = Json::object();
  for (const MemoryEntry& entry : use) json[entry.name] = entry.bytes;
  json["together"] = total_bytes(use);
  return json;
}

static Json plan_changes_json(const std::vector<PlanChange>& changes) {
  Json list = Json::array();
  for (const PlanChange& change : changes) {
    FramePlan changed;
    changed.entries = change.changed;
    list.push_back({{"frame", change.frame}, {"changed", plan_json(changed)}});
  }
  return list;
}

Json subject_json(const SessionReport& report, const ReplayOptions& options) {
  Json asset_roots = Json::array();
  for (const std::filesystem::path& root : options.asset_roots) asset_roots.push_back(root.string());
  return {{"session", session_json(report)},
          {"scene",
           {{"name", report.scene_name},
            {"file", report.scene_file.string()},
            {"asset_roots", asset_roots},
            {"triangles", report.scene_triangles}}},
          {"profile", profile_json(report.profile)},
          {"further_views", further_views_json(report)},
          {"settings", settings_json(resolved_options(options, report))}};
}

// What there is to say of a session that was refused.
static Json refusal_json(const SessionReport& report) {
  return {{"format_version", 1},
          {"program", program_with_version()},
          {"state", name_of(report.state)},
          {"exit_code", report.exit_code},
          {"error", report.error},
          {"session", {{"name", report.name}, {"folder", report.session_folder.string()}}},
          {"output", {{"folder", report.out_folder.string()}}}};
}

Json summary_json(const SessionReport& report, const ReplayOptions& options) {
  if (report.unopened) return refusal_json(report);
  Json json{{"format_version", 1},
            {"program", program_with_version()},
            {"state", name_of(report.state)},
            {"exit_code", report.exit_code}};
  if (!report.error.empty()) json["error"] = report.error;
  json.update(subject_json(report, options));
  json["frames"] = {{"first", report.range.first},
                    {"planned", report.range.count},
                    {"kept", report.kept_frames},
                    {"period_ms", report.range.period_ms()}};
  json["frames"].update(frame_counts_json(report.statistics));
  if (options.policy.deadline) json["frames"]["target_ms"] = quality_target_ms(options, report.range);
  json["latency"] = latencies_json(report.statistics);
  json["pace"] = pace_json(report.statistics);
  json["load"] = load_json(report.statistics, report.load);
  json["quality"] = quality_json(report.statistics);
  if (report.plan.camera) json["feed"] = feed_json(report.statistics);
  json["definitions"] = definitions_json(options.clock);
  json["counters"] = counters_json(report.statistics);
  json["plan"] = plan_json(report.plan);
  if (!report.plan_changes.empty()) json["plan_changes"] = plan_changes_json(report.plan_changes);
  json["memory_bytes"] = memory_json(report.memory);
  if (report.plan.probes) json["probes"] = probes_json(report.statistics);
  json["output"] = {{"folder", report.out_folder.string()},
                    {"picture_files", report.files_written},
                    {"picture_bytes", report.bytes_written},
                    {"writer_waits", report.writer_waits},
                    {"contact_sheets", report.contact_sheets}};
  json["truncated"] = report.findings.truncated;
  json["warnings"] = report.warnings;
  return json;
}

Json run_json(const std::vector<SessionReport>& reports, const ReplayOptions& options, int exit_code) {
  Json sessions = Json::array();
  RunStatistics total;
  std::size_t failed = 0;
  for (const SessionReport& report : reports) {
    sessions.push_back(summary_json(report, options));
    failed += report.state == ReplayState::failed ? 1 : 0;
    total.merge(report.statistics);
  }
  return {{"sessions", sessions},
          {"total",
           {{"sessions", reports.size()},
            {"failed_sessions", failed},
            {"frames", frame_counts_json(total)},
            {"latency", latencies_json(total)},
            {"pace", pace_json(total)},
            {"load", load_json(total, reports.empty() ? ProcessLoad() : reports.back().load)},
            {"quality", quality_json(total)},
            {"counters", counters_json(total)}}},
          {"exit_code", exit_code}};
}

std::string json_text(const Json& document) {
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace herr
