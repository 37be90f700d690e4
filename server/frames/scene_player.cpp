#include "server/frames/scene_player.h"

#include "scenes/changes/check_changes.h"
#include "scenes/document/parse_change.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {
constexpr std::size_t kWarningsKept = 20;  // a list is for reading
}

void ScenePlayer::rehearse(const Session& session, const Scene& scene) {
  ChangeRehearsal rehearsal(scene);
  const auto judged = [this](const auto& work) {
    // An entry of the timeline may stand in the way of what comes after it: until nothing does.
    for (bool again = true; again;) {
      again = false;
      try {
        work();
      } catch (const InputError& error) {
        if (!keep_going_) throw;
        ++skipped_;
        if (warnings_.size() < kWarningsKept) warnings_.emplace_back(error.what());
        again = error.line() == 0;
      }
    }
  };
  session.visit_events([&](const SceneEvent& event) {
    if (event.t_ns > session.end_ns()) return;
    judged([&] { rehearsal.play(event.json, session.events_file(), event.line, session.start_ns()); });
  });
  judged([&] { rehearsal.finish(); });
  if (const auto warning = rehearsal.w_first_warning()) warnings_.emplace_back(warning->what());
}

const SceneState& ScenePlayer::advance(Session& session, TimeNs t_ns) {
  const auto tolerated = [this](const auto& work) {
    for (bool again = true; again;) {
      again = false;
      try {
        work();
      } catch (const InputError& error) {  // the rehearsal has told of it
        if (!keep_going_) throw;
        again = error.line() == 0;
      }
    }
  };
  while (const auto event = session.next_event(t_ns)) {
    tolerated([&] {
      const SceneChange change =
          parse_event(event->json, session.events_file(), event->line, session.start_ns());
      if (const auto problem = world_.apply(change)) {
        throw InputError(session.events_file(), event->line,
                         std::string(name_of(change.kind)) + " " + problem->what, problem->remedy);
      }
    });
  }
  tolerated([&] { world_.advance(static_cast<double>(t_ns - session.start_ns()) * kSecondsPerNs); });
  return world_.state();
}

}  // namespace herr
