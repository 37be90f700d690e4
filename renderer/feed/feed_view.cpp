#include "renderer/feed/feed_view.h"

#include <glm/geometric.hpp>

namespace herr {

FeedInScene feed_in_scene(const FeedView& view, const Pose& anchored_from_eye) {
  FeedInScene out;
  out.view = view;
  out.camera_from_around = {view.camera_from_eye.position,
                            view.camera_from_eye.orientation * glm::conjugate(anchored_from_eye.orientation)};
  for (int axis = 0; axis < 3; ++axis) out.eye[axis] = static_cast<float>(anchored_from_eye.position[axis]);
  return out;
}

std::optional<glm::dvec2> camera_pixel(const FeedView& feed, const glm::dvec3& direction) {
  return feed.model->project(feed.camera_from_eye(glm::normalize(direction) * feed.distance_m));
}

std::optional<glm::dvec2> camera_pixel(const FeedInScene& feed, const glm::dvec3& direction) {
  return feed.view.model->project(feed.camera_from_around(glm::normalize(direction) * feed.view.distance_m));
}

}  // namespace herr
