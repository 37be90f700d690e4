// What the head of a recording has before it: which objects, how often, and where the recording should stand
// in the scene to have them there. Before: the poses that were kept, a scene as it was loaded. After:
// inspect_report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/model/scene.h"
#include "server/inspect/scene_facts.h"
#include "sessions/format/display_profile.h"

namespace herr {

// The region of the view that viewports of a profile cover, both eyes together, as tangents.
struct ViewBorders {
  double left = 0, right = 0, down = 0, up = 0;
};
ViewBorders view_borders(const DisplayProfile& profile);

// May something of `box` be seen? Not where it lies wholly behind the head, or wholly beyond one border: a
// box beside a corner may count although it is not seen. What stands before it is not looked at.
bool in_view(const Bounds& box, const Pose& world_from_head, const ViewBorders& borders);

// The recording's poses (session_from_head) against a scene whose recording stands at
// `scene.world_from_session`.
struct SceneInView {
  double subject_share = 0;  // of the poses, of those that have the middle of framed_sphere() in view
  // Where the recording should stand, if that is less than half: turned about the vertical, where the head
  // stands in the median, so that it looks towards that middle; or, from within the sphere, from where it is
  // smaller than 4 degrees across or more than 20 degrees up or down, moved back along its look until the
  // sphere is 40 degrees wide, on the head's height if that keeps within 20 degrees.
  std::optional<Pose> proposal;
};
// `objects` are given their shares of poses that have something of them, and their middle, in view, and the
// pose with the middle nearest to straight ahead, as they stand at the session's start; catchers and objects
// that are not there yet none. `poses` is not empty.
SceneInView look_at_scene(const Scene& scene, const std::vector<Pose>& poses, const Pose& median,
                          const DisplayProfile& profile, std::vector<SceneObject>& objects);

// A line for the scene document: "\"world_from_session\": {...}", metres to 0.1 mm.
std::string world_from_session_text(const Pose& pose);

}  // namespace herr
