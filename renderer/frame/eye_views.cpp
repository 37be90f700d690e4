// Where the eyes of a frame look, how far from there their viewports reach, and how many columns their polar
// buffers have for that. Before: the sampled gaze. After: detail levels, set_up_rays.
#include <algorithm>

#include "renderer/foveation/reached_acuity.h"
#include "renderer/frame/renderer_impl.h"

namespace herr {
namespace {

glm::dvec3 gaze_in_eye(const FrameSample& sample, Eye eye) {
  const auto e = static_cast<std::size_t>(eye);
  return glm::conjugate(sample.head_from_eye[e].orientation) * sample.gaze.head_direction[e];
}

}  // namespace

// Where each eye looks, in its own space, and how far from there its viewports reach.
void Renderer::Impl::follow_gaze(const FrameSample& sample) {
  for (const Eye eye : kEyes) {
    const auto e = static_cast<std::size_t>(eye);
    eyes[e].gaze = gaze_frame(gaze_in_eye(sample, eye));
    eyes[e].theta_max_deg = theta_max_deg(eyes[e].gaze, profile.viewports, eye);
  }
}

FrameQuality Renderer::full_quality(const FrameSample& sample) const {
  FrameQuality full = full_quality();
  if (!impl_->settings.polar_acuity) return full;
  full.polar_width = 1;
  for (const Eye eye : kEyes) {
    const GazeFrame gaze = gaze_frame(gaze_in_eye(sample, eye));
    full.polar_width =
        std::max(full.polar_width, impl_->full_width(theta_max_deg(gaze, impl_->profile.viewports, eye)));
  }
  return full;
}

int Renderer::Impl::full_width(double theta_max_deg) const {
  return polar_columns(settings, theta_max_deg);
}

// Both eyes have the same share of what each of them needs.
int Renderer::Impl::width_of(const EyeView& eye, int polar_width) const {
  const int most = full_width();
  return (full_width(eye.theta_max_deg) * polar_width + most - 1) / most;
}

}  // namespace herr
