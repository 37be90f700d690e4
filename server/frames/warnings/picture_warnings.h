// What a user would not expect of a run's pictures, one line each: darkness without a light, real surfaces
// that are not drawn, nothing in view. Before: a scene and its frame plan, what a run has counted. After: the
// warnings of replay, serve, look and inspect.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/frame_plan.h"
#include "scenes/model/scene.h"
#include "sessions/format/display_profile.h"
#include "sessions/format/pose.h"

namespace herr {

// Known before the first frame. `file` stands before each. `feed_known` false: nobody knows yet whether there
// will be a camera feed, as where a scene is inspected alone.
std::vector<std::string> picture_warnings(const Scene& scene, const std::filesystem::path& file,
                                          const FramePlan& plan, const RenderSettings& settings,
                                          bool feed_known = true);

// Of --feed-distance where `session` has no camera; empty: nothing to say. (Beside --no-camera it is an idle
// setting, of which the command line tells.)
std::string feed_distance_warning(const RenderSettings& asked, bool has_camera, const std::string& session);

// Known after `frames` frames, none of whose samples met a virtual object: where the head stood in the scene,
// where it looked, and how far off that the nearest object is, or that it is too small or stands about the
// head. Without a head these are left out.
std::string nothing_seen_warning(const Scene& scene, std::int64_t frames,
                                 const std::optional<Pose>& world_from_head, const DisplayProfile& profile);

// The same of what was measured, not drawn: a gate may be green over empty frames. Empty where
// `object_samples` is not 0.
std::string nothing_measured_warning(double object_samples);

// Of objects whose size suggests another unit than metres, as they stand at the session's start, for a head
// at `place` in the scene: the one that looks smallest of those under kFewPixels of the finest viewport,
// straight ahead, and the largest of those of kHuge_m and more about the head. `file` stands before each
// line.
std::vector<std::string> size_warnings(const Scene& scene, const std::filesystem::path& file,
                                       const glm::dvec3& place, const DisplayProfile& profile);
inline constexpr double kFewPixels = 4, kHuge_m = 100;

}  // namespace herr
