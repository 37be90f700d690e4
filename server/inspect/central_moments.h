// When the head looked at the middle of an object: the second to start a replay at. Before: look_at_scene has
// chosen the pose. After: inspect_text, inspect_json.
#pragma once

#include <vector>

#include "server/inspect/scene_facts.h"
#include "sessions/format/pose.h"

namespace herr {

// Gives each object with a `most_central` pose the seconds from `start_ns` to the stamp of the first of
// `poses` that is the same, rounded down to a tenth so that they lie in the session; none where all such come
// before `start_ns`. `stamps_ns` are those of `poses`.
void find_central_moments(const std::vector<Pose>& poses, const std::vector<TimeNs>& stamps_ns,
                          TimeNs start_ns, std::vector<SceneObject>& objects);

}  // namespace herr
