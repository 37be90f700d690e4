#include "server/inspect/inspect_report.h"

#include <algorithm>
#include <cctype>
#include <system_error>
#include <utility>

#include "scenes/load_scene.h"
#include "server/frames/warnings/picture_warnings.h"
#include "server/inspect/central_moments.h"
#include "server/inspect/event_findings.h"
#include "server/process/exit_code.h"
#include "server/text/shell_word.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

void inspect_scene(const InspectOptions& options, bool session_has_camera, InspectReport& report) {
  try {
    // Sizes of textures are facts enough, unless probes are to be lit by them.
    const bool pixels = options.decode || !options.probes.folder.empty();
    Scene scene = load_scene(report.scene_file, pixels ? TexturePixels::decoded : TexturePixels::left_out,
                             DefaultLight::above, options.asset_roots);
    report.scene = facts_of(scene);
    report.plan = plan_frame(scene, options.render, session_has_camera);
    if (report.session && report.session->head.median().rows() > 0) {
      const MedianPose& poses = report.session->head.median();
      report.in_view =
          look_at_scene(scene, poses.kept(), poses.pose(), report.profile, report.scene->objects);
      if (report.session->span)
        find_central_moments(poses.kept(), poses.kept_ns(), report.session->span->start_ns,
                             report.scene->objects);
    }
    for (const std::string& warning : scene.warnings)
      report.findings.add(Severity::warning, InputError("", 0, warning, ""));
    for (const std::string& warning :
         picture_warnings(scene, report.scene_file, *report.plan, options.render, report.session.has_value()))
      report.findings.add(Severity::warning, InputError("", 0, warning, ""));
    if (report.in_view) {
      const glm::dvec3 place = scene.world_from_session(report.session->head.median().place_m());
      for (const std::string& warning : size_warnings(scene, report.scene_file, place, report.profile))
        report.findings.add(Severity::warning, InputError("", 0, warning, ""));
    }
    if (report.session) {
      const std::string name = report.session->folder.filename().string();
      const std::string warning = feed_distance_warning(options.render, session_has_camera, name);
      if (!warning.empty()) report.findings.add(Severity::warning, InputError("", 0, warning, ""));
    }
    if (report.scene->degenerate_triangles > 0)
      report.findings.add(Severity::note, InputError(report.scene_file, 0,
                                                     counted(report.scene->degenerate_triangles,
                                                             "triangle has no area: no ray can hit it",
                                                             "triangles have no area: no ray can hit them"),
                                                     "leave them out when the model is exported again"));
    const bool has_events = report.session && report.session->event_rows > 0 && report.session->span;
    if (has_events) {
      inspect_events(scene, report.session->folder / "events.jsonl", report.session->span->start_ns,
                     report.findings);
    }
    if (!options.probes.folder.empty()) report.loaded = std::move(scene);
  } catch (const InputError& error) {
    report.findings.add(Severity::error, error);
  }
}

void inspect_recording(const std::filesystem::path& folder, const InspectOptions& options,
                       InspectReport& report) {
  InspectionRequest request{folder, options.strict, options.decode};
  if (!options.profile.empty()) {
    report.profile = scaled_profile(load_display_profile(options.profile), options.profile_scale);
    request.display_hz = report.profile.display_hz;
  }
  report.session = inspect_session(request);
  const SessionInspection& session = *report.session;
  report.findings = session.findings;
  if (options.profile.empty() && session.header)
    report.profile = scaled_profile(session.header->profile, options.profile_scale);
  if (session.span)
    report.frames =
        frames_to_replay(session.span->start_ns, session.span->end_ns, report.profile.display_hz, {});
  if (!options.scene.empty())
    report.scene_file = options.scene;
  else if (session.header && !session.header->scene.empty())
    report.scene_file = folder / session.header->scene;
  if (!report.scene_file.empty()) return inspect_scene(options, session.has_camera_feed(), report);
  if (session.header)
    report.findings.add(Severity::note, InputError(folder / "session.json", 0, "names no scene",
                                                   "give --scene FILE for the frame plan and for replay"));
}

// A session may be named by its header, too.
bool is_header(const std::filesystem::path& path) {
  return path.filename() == "session.json";
}

bool is_scene(const std::filesystem::path& path) {
  return path_exists(path) && !is_folder(path) && !is_header(path);  // opening it says what else is wrong
}

bool has_scene_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".json" || ending == ".gltf" || ending == ".glb" || ending == ".vox";
}

// A table, a log: the way from it to a session.
InputError no_session_yet(const std::filesystem::path& path) {
  const std::filesystem::path above = std::filesystem::absolute(path).parent_path().parent_path();
  if (path_exists(above / "session.json"))
    return InputError(path, 0, "is one stream of a session",
                      "inspect the session: 'herr inspect " + shell_path(above) + "'");
  return InputError(path, 0, "is neither a session nor a scene",
                    "make a session of a recording: 'herr convert " + shell_path(path) +
                        " OUT', or name a .scene.json, .gltf, .glb or .vox file");
}

void add_acuity(InspectReport& report) {
  report.acuity = acuity_facts(report.settings, report.profile);
  if (report.acuity && report.session && report.frames)
    add_recorded_acuity(report.settings, report.profile, *report.session, *report.frames, *report.acuity);
}

InspectReport inspected(const InspectOptions& options) {
  InspectReport report;
  report.path = options.path;
  report.settings = options.render;
  if (!is_scene(options.path)) {
    std::filesystem::path folder = options.path;
    if (is_header(folder)) folder = folder.has_parent_path() ? folder.parent_path() : ".";
    inspect_recording(folder, options, report);
    return report;
  }
  if (!options.scene.empty())
    throw UsageError("--scene: " + printable(options.path.string()) +
                     " is a scene itself; leave the flag out, or name a session");
  report.profile = scaled_profile(
      options.profile.empty() ? xr1_profile() : load_display_profile(options.profile), options.profile_scale);
  if (!has_scene_ending(options.path)) {
    report.findings.add(Severity::error, no_session_yet(options.path));
    return report;
  }
  report.scene_file = options.path;
  inspect_scene(options, false, report);
  return report;
}

}  // namespace

InspectReport inspect(const InspectOptions& options) {
  InspectReport report = inspected(options);
  add_acuity(report);
  return report;
}

}  // namespace herr
