// What a session's events do to its scene, and which of them cannot. Before: inspect_session, load_scene.
// After: findings of `herr inspect`.
#pragma once

#include <filesystem>

#include "scenes/model/scene.h"
#include "sessions/format/pose.h"
#include "sessions/inspect/findings.h"

namespace herr {

// A note that counts the changes of each kind, and an error for each event that cannot be applied.
void inspect_events(const Scene& scene, const std::filesystem::path& events_jsonl, TimeNs start_ns,
                    FindingList& findings);

}  // namespace herr
