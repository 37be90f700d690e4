#include "server/frames/opened_session.h"

#include <string>
#include <utility>
#include <vector>

#include "scenes/load_scene.h"
#include "server/frames/auto_exposure.h"
#include "server/frames/warnings/picture_warnings.h"
#include "server/process/exit_code.h"
#include "server/results/memory_parts.h"
#include "server/settings/view_file.h"
#include "sessions/files/input_error.h"
#include "sessions/text/fixed_text.h"

namespace herr {
namespace {

void open_scene(const ReplayOptions& options, SessionReport& report, OpenedSession& opened) {
  const std::string& named = report.header.scene;
  if (options.scene.empty() && named.empty()) {
    throw UsageError("--scene: " + printable(report.name) + " names no scene; give --scene FILE");
  }
  report.scene_file =
      options.scene.empty() ? opened.session->folder() / named : std::filesystem::path(options.scene);
  opened.scene = load_scene(report.scene_file, options.asset_roots);
  opened.scene.changes = opened.scene.changes || report.findings.event_rows > 0;
  opened.player.emplace(opened.scene, options.session.keep_going);
  opened.player->rehearse(*opened.session, opened.scene);
  report.scene_name = opened.scene.name;
  report.scene_triangles = triangle_count(opened.scene, false);
}

// Its picture joins those of the viewports, under its own name.
std::optional<OutsideView> view_of(const ReplayOptions& options, const DisplayProfile& profile,
                                   std::vector<std::string>& warnings) {
  if (options.view.empty()) return std::nullopt;
  const OutsideView view = load_view_file(options.view, warnings);
  for (const Viewport& viewport : profile.viewports) {
    if (viewport.name != view.name) continue;
    throw InputError(options.view, 0,
                     "field name is '" + view.name + "', as a viewport of the display profile is called",
                     "give the view another name");
  }
  return view;
}

}  // namespace

void open_recording(const ReplayOptions& options, const SessionReport& report, OpenedSession& opened) {
  opened.session.emplace(Session::open(report.session_folder, options.session));
}

void build_renderer(const RenderSettings& settings, const SessionReport& report, OpenedSession& opened) {
  opened.renderer.reset();  // first, so that memory holds one
  RenderSettings asked = settings;
  if (!asked.feed_distance_m) asked.feed_distance_m = report.header.feed_distance_m;
  const bool has_camera = report.findings.camera_rows[0] > 0;
  opened.renderer = std::make_unique<Renderer>(opened.scene, report.profile, asked, has_camera);
}

void open_inputs(const ReplayOptions& options, SessionReport& report, OpenedSession& opened) {
  open_recording(options, report, opened);
  const Session& session = *opened.session;
  report.header = session.header();
  report.findings = session.findings();
  report.profile =
      scaled_profile(options.profile.empty() ? report.header.profile : load_display_profile(options.profile),
                     options.profile_scale);
  report.settings = options.render;
  std::vector<std::string> warnings;
  report.settings.outside = view_of(options, report.profile, warnings);
  // In real time a frame of the session is a tick of the display.
  const bool own_period = options.target_ms && options.clock == ReplayClock::realtime;
  const double display_hz = own_period ? 1e3 / *options.target_ms : report.profile.display_hz;
  report.range = frames_to_replay(session.start_ns(), session.end_ns(), display_hz,
                                  {options.start_s, options.duration_s, options.frames});
  if (report.range.count == 0) {
    const double seconds = static_cast<double>(session.end_ns() - session.start_ns()) * kSecondsPerNs;
    throw UsageError("--start, --duration: no frame of " + printable(report.name) +
                     " lies in that span; the session lasts " + fixed_text(seconds, 2) + " s");
  }
  open_scene(options, report, opened);
  opened.scene.warnings.insert(opened.scene.warnings.end(), warnings.begin(), warnings.end());
}

void open_session(const ReplayOptions& options, SessionReport& report, OpenedSession& opened) {
  open_inputs(options, report, opened);
  build_renderer(report.settings, report, opened);
  if (opened.renderer->settings().auto_exposure) {
    choose_exposure(report, opened);
    open_recording(options, report, opened);  // from its start again
  }
  report.plan = opened.renderer->plan();
  if (std::string warning =
          feed_distance_warning(options.render, report.findings.camera_rows[0] > 0, report.name);
      !warning.empty())
    opened.scene.warnings.push_back(std::move(warning));
  for (std::string& warning :
       picture_warnings(opened.scene, report.scene_file, report.plan, opened.renderer->settings()))
    opened.scene.warnings.push_back(std::move(warning));
  report.memory = memory_parts(*opened.renderer, opened.scene, {});
  report.load = process_load();
  report.settings = opened.renderer->settings();
}

}  // namespace herr
