// When the head looked at the middle of an object: the second to start a replay at. Before: look_at_scene has
// chosen the pose. After: inspect_text, inspect_json.
#pragma once

#include <filesystem>
#include <vector>

#include "server/inspect/scene_facts.h"
#include "sessions/format/pose.h"

namespace herr {

// Reads the poses of `session_folder` once more and gives each object with a `most_central` pose the seconds
// from `start_ns` to the first row that has it, rounded down to a tenth so that they lie in the session; none
// where that row comes before `start_ns`.
void find_central_moments(const std::filesystem::path& session_folder, TimeNs start_ns,
                          std::vector<SceneObject>& objects);

}  // namespace herr
