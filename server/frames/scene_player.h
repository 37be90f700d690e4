// Joins a session's events to its scene: brings the scene to a frame's time.
// Before: open_session checks every event. After: the renderer takes SceneState.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/changes/world.h"
#include "scenes/model/scene.h"
#include "sessions/session.h"

namespace herr {

class ScenePlayer {
 public:
  // `scene` must outlive it. `keep_going`: changes that cannot be made are left out and counted.
  ScenePlayer(Scene& scene, bool keep_going) : world_(scene), keep_going_(keep_going) {}

  // Plays all events and the timeline on names alone, before the first frame; memory does not grow with their
  // number. Throws InputError for the first that cannot be made (unless keep_going).
  void rehearse(const Session& session, const Scene& scene);
  std::int64_t skipped_changes() const { return skipped_; }  // as the rehearsal found
  const std::vector<std::string>& warnings() const {
    return warnings_;
  }  // of the first few of those, and others

  // The scene as it was loaded, for a session opened anew.
  void restart() { world_.restart(); }
  // Events of the session up to t_ns that were not yet applied, timeline and animation. Times never decrease.
  const SceneState& advance(Session& session, TimeNs t_ns);
  const SceneState& state() const { return world_.state(); }

 private:
  World world_;
  bool keep_going_;
  std::int64_t skipped_ = 0;
  std::vector<std::string> warnings_;
};

}  // namespace herr
