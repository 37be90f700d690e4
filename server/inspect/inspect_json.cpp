#include "server/inspect/inspect_json.h"

#include <nlohmann/json.hpp>

#include "server/inspect/acuity/acuity_json.h"
#include "server/inspect/mirror_words.h"
#include "server/inspect/time_plot.h"
#include "server/process/exit_code.h"
#include "server/process/version.h"
#include "server/results/settings_report.h"
#include "server/results/summary_json.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/plausibility.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

double ms(double ns) {
  return ns * 1e-6;
}
double ms(TimeNs ns) {
  return static_cast<double>(ns) * 1e-6;
}

Json vector_json(const glm::dvec3& v) {
  return Json::array({v.x, v.y, v.z});
}

Json finding_json(const Finding& finding) {
  Json json{{"severity", name_of(finding.severity)},
            {"file", finding.first.file()},
            {"line", finding.first.line() > 0 ? Json(finding.first.line()) : Json()},
            {"problem", finding.first.problem()},
            {"remedy", finding.first.remedy()},
            {"count", finding.count},
            {"skippable", finding.skippable}};
  if (finding.count > 1) json["last_line"] = finding.last_line > 0 ? Json(finding.last_line) : Json();
  if (!finding.others.empty()) json["others"] = finding.others;
  return json;
}

Json ages_json(const FrameAges& ages) {
  const IntervalCensus& census = ages.ages();
  const bool any = census.intervals() > 0;
  return {{"p50_ms", any ? Json(ms(census.quantile_ns(0.5))) : Json()},
          {"p95_ms", any ? Json(ms(census.quantile_ns(0.95))) : Json()},
          {"max_ms", any ? Json(ms(census.widest_ns())) : Json()},
          {"frames", ages.frames()},
          {"frames_without", ages.frames_without()}};
}

Json stream_json(const StreamSummary& stream, const SessionInspection& session) {
  Json gaps = Json::array();
  for (const StreamGap& gap : stream.longest_gaps())
    gaps.push_back({{"ms", ms(gap.length_ns)}, {"end_ns", gap.end_ns}, {"end_line", gap.end_line}});
  const bool any = stream.rows > 0, rate = stream.rows > 1;
  Json json{{"name", stream.name},
            {"file", stream.file.string()},
            {"rows", stream.rows},
            {"first_ns", any ? Json(stream.first_ns) : Json()},
            {"last_ns", any ? Json(stream.last_ns) : Json()},
            {"span_s", stream.span_s()},
            {"nominal_hz", stream.nominal_hz > 0 ? Json(stream.nominal_hz) : Json()},
            {"median_hz", rate ? Json(stream.median_hz()) : Json()},
            {"mean_hz", rate ? Json(stream.mean_hz()) : Json()},
            {"jitter_ms", rate ? Json(ms(stream.intervals.jitter_ns())) : Json()},
            {"longest_interval_ms", rate ? Json(ms(stream.intervals.widest_ns())) : Json()},
            {"longest_interval_line", rate ? Json(stream.intervals.widest_line()) : Json()},
            {"gaps", stream.intervals.hitches()},
            {"longest_gaps", gaps},
            {"repeated_values", stream.repeated_values}};
  if (session.span && stream.ages) json["age_at_frames"] = ages_json(*stream.ages);
  if (&stream == &session.poses || !any || session.poses.rows == 0) return json;
  const StreamOffset offset = offset_to(session.poses, stream);
  json["offset_to_poses"] = {{"start_ms", ms(offset.start_ns)},
                             {"end_ms", ms(offset.end_ns)},
                             {"change_ms", ms(offset.change_ns)},
                             {"resolution_ms", ms(offset.resolution_ns)},
                             {"drift_ppm", offset.drift_ppm ? Json(*offset.drift_ppm) : Json()}};
  return json;
}

Json streams_json(const SessionInspection& session) {
  Json streams = Json::array({stream_json(session.poses, session)});
  if (session.gaze) streams.push_back(stream_json(*session.gaze, session));
  for (const std::optional<StreamSummary>& camera : session.cameras)
    if (camera) streams.push_back(stream_json(*camera, session));
  return streams;
}

Json quantiles_json(const LinearHistogram& values) {
  if (values.count() == 0) return {{"p50", nullptr}, {"p95", nullptr}, {"max", nullptr}};
  return {{"p50", values.quantile(0.5)}, {"p95", values.quantile(0.95)}, {"max", values.max()}};
}

Json plot_json(const TimeProfile& profile, const SessionSpan& span) {
  Json mean = Json::array(), peak = Json::array(), lost = Json::array();
  for (const ProfileSpan& column : profile.columns(span.start_ns, span.end_ns, kPlotColumns)) {
    mean.push_back(column.values > 0 ? Json(column.mean()) : Json());
    peak.push_back(column.values > 0 ? Json(column.peak) : Json());
    lost.push_back(column.without);
  }
  return {{"mean", mean}, {"peak", peak}, {"lost_rows", lost}};
}

Json head_json(const SessionInspection& session) {
  const HeadMeter& head = session.head;
  Json json{{"turn_deg_per_s", quantiles_json(head.turn_deg_s())},
            {"move_m_per_s", quantiles_json(head.move_m_s())},
            {"path_m", head.path_m()},
            {"turned_deg", head.turned_deg()},
            {"lower_m", vector_json(head.lower_m())},
            {"upper_m", vector_json(head.upper_m())},
            {"median_m", vector_json(head.median().place_m())},
            {"median_forward", vector_json(head.median().forward())},
            {"worst_quaternion_norm_error", head.worst_norm_error()}};
  if (session.span) {
    json["turn_over_time"] = plot_json(head.turn_profile(), *session.span);
    json["move_over_time"] = plot_json(head.move_profile(), *session.span);
  }
  return json;
}

Json share_json(const std::optional<double>& share) {
  return share ? Json(*share) : Json();
}

Json plausibility_json(const PlausibilityMeter& meter) {
  const PlausibilityFigures figures = meter.figures();
  return {{"words", meter.words()},
          {"level_share", share_json(figures.level_share)},
          {"median_tilt_deg", figures.median_tilt_deg},
          {"median_roll_deg", figures.median_roll_deg},
          {"median_pitch_deg", figures.median_pitch_deg},
          {"up_spread_deg", figures.up_spread_deg},
          {"right_spread_deg", figures.right_spread_deg},
          {"forward_spread_deg", figures.forward_spread_deg},
          {"mean_up", vector_json(figures.mean_up)},
          {"mean_right", vector_json(figures.mean_right)},
          {"mean_forward", vector_json(figures.mean_forward)},
          {"head_turns", figures.head_turns},
          {"head_moves", figures.head_moves},
          {"forwards_share", share_json(figures.forwards_share)},
          {"gaze_words", meter.gaze_words()},
          {"diverging_share", share_json(figures.diverging_share)},
          {"same_ray_share", share_json(figures.same_ray_share)},
          {"off_axis_share", share_json(figures.off_axis_share)},
          {"median_gaze_deg", figures.median_gaze_deg},
          {"countering_sideways_share", share_json(figures.countering_x)},
          {"countering_up_and_down_share", share_json(figures.countering_y)},
          {"countering_windows", figures.countering_windows},
          {"countering_sideways_evidence", figures.evidence_x},
          {"countering_up_and_down_evidence", figures.evidence_y},
          {"gaze_axes_evidence", figures.evidence_not_exchanged}};
}

Json eyes_json(const SessionInspection& session) {
  const GazeMeter& eyes = session.eyes;
  Json json{{"eccentricity_deg", quantiles_json(eyes.eccentricity_deg())},
            {"rows", eyes.rows()},
            {"lost_rows", eyes.lost_rows()},
            {"either_lost_rows", eyes.either_lost_rows()},
            {"lost_rows_left", eyes.lost_rows_of(0)},
            {"lost_rows_right", eyes.lost_rows_of(1)},
            {"off_axis_rows", eyes.off_axis_rows()},
            {"lost_share", eyes.lost_share()},
            {"blinks", eyes.blinks()},
            {"losses", eyes.losses()},
            {"longest_loss_ms", ms(eyes.longest_loss_ns())},
            {"longest_loss_line", eyes.longest_loss_line() > 0 ? Json(eyes.longest_loss_line()) : Json()},
            {"worst_norm_error", eyes.worst_norm_error()}};
  if (session.span) json["eccentricity_over_time"] = plot_json(eyes.eccentricity_profile(), *session.span);
  return json;
}

Json conversion_json(const SessionConversion& conversion) {
  Json left_out = Json::array();
  for (const SessionConversion::LeftOut& part : conversion.left_out)
    left_out.push_back(
        {{"stream", part.stream}, {"rows", part.rows}, {"of", part.of}, {"reason", part.reason}});
  return {{"left_out", left_out}, {"assumed", conversion.assumed}, {"remarks", conversion.remarks}};
}

Json session_json(const InspectReport& report) {
  const SessionInspection& session = *report.session;
  Json json{{"folder", session.folder.string()}};
  if (session.header) {
    const SessionHeader& header = *session.header;
    json["name"] = header.name;
    json["provenance"] = header.provenance;
    json["licence"] = header.licence;
    json["gaze_kind"] = header.gaze_combined ? "combined" : "per_eye";
    json["vergence_m"] = header.vergence_m ? Json(*header.vergence_m) : Json();
    json["scene"] = header.scene;
    json["cameras"] = header.cameras.size();
    json["feed_distance_m"] = header.feed_distance_m ? Json(*header.feed_distance_m) : Json();
    json["conversion"] = header.conversion.empty() ? Json() : conversion_json(header.conversion);
  }
  if (session.span) {
    json["start_ns"] = session.span->start_ns;
    json["end_ns"] = session.span->end_ns;
    json["frames"] = report.frames->count;
  }
  json["truncated"] = session.truncated;
  json["event_rows"] = session.event_rows;
  json["decoded_pictures"] = session.decoded_pictures;
  json["sanitised_camera_values"] = session.sanitised_values;
  json["streams"] = streams_json(session);
  json["head"] = head_json(session);
  if (session.gaze) json["eyes"] = eyes_json(session);
  if (session.poses.rows > 0) json["plausibility"] = plausibility_json(session.plausibility);
  return json;
}

Json scene_json(const InspectReport& report) {
  const SceneFacts& scene = *report.scene;
  Json objects = Json::array(), files = Json::array();
  for (const SceneObject& object : scene.objects)
    objects.push_back(
        {{"name", object.name},
         {"instances", object.instances},
         {"triangles", object.triangles},
         {"voxels", object.voxels},
         {"catcher", object.catcher},
         {"in_view_share", object.in_view ? Json(*object.in_view) : Json()},
         {"middle_in_view_share", object.middle_in_view ? Json(*object.middle_in_view) : Json()},
         {"most_central_s", object.most_central_s ? Json(*object.most_central_s) : Json()}});
  Json grids = Json::array();
  for (const GridFacts& grid : scene.grids)
    grids.push_back({{"name", grid.name},
                     {"counts", {grid.counts.x, grid.counts.y, grid.counts.z}},
                     {"voxels", grid.voxels},
                     {"bytes", grid.bytes}});
  for (const std::filesystem::path& file : scene.files) files.push_back(file.string());
  return {{"name", scene.name},
          {"file", report.scene_file.string()},
          {"files", files},
          {"instances", scene.instances},
          {"catchers", scene.catchers},
          {"meshes", scene.meshes},
          {"triangles", scene.triangles},
          {"catcher_triangles", scene.catcher_triangles},
          {"spheres", scene.spheres},
          {"boxes", scene.boxes},
          {"stored_triangles", scene.stored_triangles},
          {"degenerate_triangles", scene.degenerate_triangles},
          {"materials", scene.materials},
          {"mirrors", scene.mirrors},
          {"emitters", scene.emitters},
          {"textures", scene.textures},
          {"texture_pixels", scene.texture_pixels},
          {"lights", scene.lights},
          {"moving_lights", scene.moving_lights},
          {"virtual_lights", scene.virtual_lights},
          {"moving_objects", scene.moving_objects},
          {"ambient", vector_json(scene.ambient)},
          {"environment", vector_json(scene.environment)},
          {"exposure_ev", scene.exposure && !scene.exposure->automatic ? Json(scene.exposure->ev) : Json()},
          {"auto_exposure", scene.exposure && scene.exposure->automatic},
          {"lower_m", vector_json(scene.bounds.lower)},
          {"upper_m", vector_json(scene.bounds.upper)},
          {"geometry_bytes", scene.geometry_bytes},
          {"texture_bytes", scene.texture_bytes},
          {"voxel_bytes", scene.voxel_bytes},
          {"voxel_grids", grids},
          {"objects", objects}};
}

Json in_view_json(const SceneInView& in_view) {
  Json json{{"subject_share", in_view.subject_share}, {"world_from_session", nullptr}};
  if (!in_view.proposal) return json;
  const glm::dquat& q = in_view.proposal->orientation;
  json["world_from_session"] = {{"position", vector_json(in_view.proposal->position)},
                                {"orientation_xyzw", {q.x, q.y, q.z, q.w}}};
  return json;
}

Json probe_dump_json(const ProbeDump& dump) {
  Json files = Json::array();
  for (const ProbeDump::File& file : dump.files) files.push_back(file.name);
  return {{"folder", dump.folder.string()},
          {"files", files},
          {"updates", dump.updates},
          {"probes", dump.probes},
          {"active", dump.active},
          {"relocated", dump.relocated},
          {"inactive", dump.dark + dump.far},
          {"dark", dump.dark},
          {"far", dump.far},
          {"variability", dump.variability}};
}

}  // namespace

Json inspect_json(const InspectReport& report) {
  Json findings = Json::array();
  for (const Finding& finding : report.findings.sorted()) findings.push_back(finding_json(finding));
  Json json{{"format_version", 1},
            {"program", program_with_version()},
            {"path", report.path.string()},
            {"kind", report.session ? "session" : "scene"},
            {"sound", report.sound()},
            {"exit_code", report.sound() ? kExitDone : kExitBadInput},
            {"counts",
             {{"errors", report.findings.count(Severity::error)},
              {"skippable_errors", report.findings.skippable_errors()},
              {"warnings", report.findings.count(Severity::warning)},
              {"notes", report.findings.count(Severity::note)}}},
            {"findings", findings}};
  if (report.session) json["session"] = session_json(report);
  json["profile"] = {{"name", report.profile.name}, {"display_hz", report.profile.display_hz}};
  if (report.scene) json["scene"] = scene_json(report);
  if (report.in_view) json["in_view"] = in_view_json(*report.in_view);
  json["settings"] = settings_text(report.settings, report.has_camera_feed());
  if (report.plan) json["plan"] = plan_json(*report.plan);
  if (report.acuity) json["acuity"] = acuity_json(*report.acuity);
  if (!report.acuity_plot.empty()) json["acuity"]["plot"] = report.acuity_plot.string();
  if (report.plan) json["mirrors_and_glass"] = mirror_words(report);
  if (report.probes) json["probes"] = probe_dump_json(*report.probes);
  return json;
}

}  // namespace herr
