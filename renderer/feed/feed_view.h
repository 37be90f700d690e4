// The camera feed of one eye in a frame: where the camera saw what lies in a direction from the eye. The feed
// is taken to lie on a sphere about the eye.
// Before: the frame's sample. After: viewports/ shows it behind everything, lighting/ in mirrors and glass.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "sessions/camera/camera_image.h"
#include "sessions/camera/camera_model.h"
#include "sessions/format/pose.h"

namespace herr {

struct FeedView {
  const CameraImage* image = nullptr;  // at least 2x2 (camera_feed.h); null: no feed
  const CameraModel* model = nullptr;
  Pose camera_from_eye;     // at the frame's exposure against the eye now
  double distance_m = 2.0;  // the feed is taken to lie on a sphere of this radius about the eye
  float white = 1;          // radiance that the feed's white is shown as: 1 / exposure
};

// The same for rays from anywhere in the scene.
struct FeedInScene {
  FeedView view;
  Pose camera_from_around;  // of vectors from the eye, in the scene's axes
  float eye[3] = {};        // metres from the anchor
};
FeedInScene feed_in_scene(const FeedView& view, const Pose& anchored_from_eye);

// Exact camera pixel of what is shown in a direction (of any length) from the eye, in eye space or in the
// scene's axes; none where the model does not see it. Thread-safe.
std::optional<glm::dvec2> camera_pixel(const FeedView& feed, const glm::dvec3& direction);
std::optional<glm::dvec2> camera_pixel(const FeedInScene& feed, const glm::dvec3& direction);

}  // namespace herr
