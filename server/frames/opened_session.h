// A session that is ready to be rendered: recording, scene and renderer, opened and checked.
// Before: folder and options. After: FrameStep, in the loops of replay, serve, check and bench.
#pragma once

#include <memory>
#include <optional>

#include "renderer/renderer.h"
#include "scenes/model/scene.h"
#include "server/frames/scene_player.h"
#include "server/results/session_report.h"
#include "server/settings/replay_options.h"
#include "sessions/session.h"

namespace herr {

// The renderer refers to the scene: an object of this kind stays where it is.
struct OpenedSession {
  std::optional<Session> session;
  Scene scene;
  std::optional<ScenePlayer> player;  // brings the scene to a frame's time
  std::unique_ptr<Renderer> renderer;

  OpenedSession() = default;
  OpenedSession(const OpenedSession&) = delete;
  OpenedSession& operator=(const OpenedSession&) = delete;
};

// Reads and checks everything in report.session_folder, its scene and --view; no renderer is made of them.
// Writes nothing but `opened` and what `report` says about the session, its scene and what is to be rendered;
// report.settings are what was asked for. Throws InputError and UsageError; `report` then holds what was
// found until then.
void open_inputs(const ReplayOptions& options, SessionReport& report, OpenedSession& opened);

// open_inputs(), then the renderer; `report` says how is rendered, too.
void open_session(const ReplayOptions& options, SessionReport& report, OpenedSession& opened);

// The recording alone once more, from its start: time in a session never goes back. Throws as Session::open.
void open_recording(const ReplayOptions& options, const SessionReport& report, OpenedSession& opened);
// Another renderer of the scene as it is now.
void build_renderer(const RenderSettings& settings, const SessionReport& report, OpenedSession& opened);

}  // namespace herr
