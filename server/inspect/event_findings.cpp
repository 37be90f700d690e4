#include "server/inspect/event_findings.h"

#include <string>

#include "scenes/changes/check_changes.h"
#include "scenes/document/parse_change.h"
#include "sessions/files/input_error.h"
#include "sessions/streams/event_stream.h"

namespace herr {

void inspect_events(const Scene& scene, const std::filesystem::path& events_jsonl, TimeNs start_ns,
                    FindingList& findings) {
  ChangeRehearsal rehearsal(scene);
  const auto judged = [&](const auto& work) {
    // An entry of the timeline may stand in the way of what comes after it: until nothing does.
    for (bool again = true; again;) {
      again = false;
      try {
        work();
      } catch (const InputError& error) {
        findings.add(Severity::error, error);
        again = error.line() == 0;
      }
    }
  };
  EventStream events(events_jsonl, RowPolicy{true, {}});  // what is no event at all has been told of
  while (const auto event = events.next()) {
    judged([&] { rehearsal.play(event->json, events_jsonl, event->line, start_ns); });
  }
  judged([&] { rehearsal.finish(); });
  if (const auto warning = rehearsal.w_first_warning()) findings.add(Severity::warning, *warning);
  std::string kinds;
  for (std::size_t kind = 0; kind < rehearsal.counts().size(); ++kind) {
    if (rehearsal.counts()[kind] == 0) continue;
    if (!kinds.empty()) kinds += ", ";
    kinds += std::to_string(rehearsal.counts()[kind]) + " " + name_of(static_cast<ChangeKind>(kind));
  }
  if (kinds.empty()) return;
  findings.add(Severity::note, InputError(events_jsonl, 0, "changes the scene: " + kinds, ""));
}

}  // namespace herr
