// What each eye is shown of the camera in this frame. Before: acceleration structures followed the head.
// After: rays (mirrors and glass show it), viewports (it lies behind everything).
#include "renderer/feed/camera_feed.h"
#include "renderer/frame/renderer_impl.h"

namespace herr {

void Renderer::Impl::set_up_feeds(const FrameSample& sample) {
  for (std::size_t eye = 0; eye < feeds.size(); ++eye) {
    feeds[eye] = {};
    if (!plan.camera || !sample.cameras[eye]) continue;
    const SampledCamera& camera = *sample.cameras[eye];
    FeedView feed;
    feed.white = 1.0f / shown_scale();
    feed.image = at_least_2x2(*camera.image, enlarged_feeds[eye]);
    feed.model = camera.model;
    feed.camera_from_eye =
        inverse(camera.world_from_camera) * (sample.head.world_from_head * sample.head_from_eye[eye]);
    feed.distance_m = settings.feed_distance_m.value_or(kUsualFeedDistance_m);
    feeds[eye] = feed_in_scene(feed, eyes[eye].anchored_from_eye);
  }
}

}  // namespace herr
