#include "sessions/import/cameras/camera_on_head.h"

namespace herr {

Pose camera_on_head(const Pose& body_from_camera, const HeadColumns& head) {
  const auto lens = AxisDirections::from_words({"right", "down", "forward"});
  const Pose head_from_camera = inverse(head.body_from_head) * body_from_camera;
  return {head.head_axes.to_ours(head_from_camera.position),
          rotation_to_ours(head_from_camera.orientation, head.head_axes, *lens)};
}

}  // namespace herr
