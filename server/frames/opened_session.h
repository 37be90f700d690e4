// A session that is ready to be rendered: recording, scene and renderer, opened and checked.
// Before: folder and options. After: the loops of `herr replay` and `herr serve`.
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

// Reads and checks everything in report.session_folder; writes nothing but `opened` and what `report` says
// about the session, its scene, what is to be rendered and how. Throws InputError and UsageError; `report`
// then holds what was found until then.
void open_session(const ReplayOptions& options, SessionReport& report, OpenedSession& opened);

}  // namespace herr
