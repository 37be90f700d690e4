#include "server/results/run_state.h"

#include <algorithm>

namespace herr {

RunTracker::RunTracker(Session& session, Renderer& renderer, std::int64_t first_frame)
    : session_(session),
      renderer_(renderer),
      opened_(session.findings()),
      skipped_before_(opened_.skipped_images),
      warnings_before_(opened_.warnings.size()) {
  state_.next_frame = first_frame;
}

void RunTracker::restore(const RunState& state, std::optional<TimeNs> last_frame_ns) {
  state_ = state;
  sanitised_values_ = state.sanitised_camera_values;
  renderer_.restore(state.renderer);
  // The image that was shown may be older than the newest row, where that one did not decode: at the image's
  // own stamp it is the newest.
  std::vector<TimeNs> stamps;
  for (const auto& stamp : state.camera_stamps_ns) {
    if (stamp) stamps.push_back(std::max(*stamp, session_.start_ns()));
  }
  std::sort(stamps.begin(), stamps.end());
  // What did not decode up to the last frame is known: it is met here, not once more with the next frame.
  if (last_frame_ns) stamps.push_back(*last_frame_ns);
  for (const TimeNs stamp : stamps) show(session_.sample(stamp));
  skipped_before_ = session_.findings().skipped_images;
  warnings_before_ = session_.findings().warnings.size();
}

void RunTracker::show(const FrameSample& sample) {
  for (std::size_t eye = 0; eye < sample.cameras.size(); ++eye) {
    if (!sample.cameras[eye]) continue;
    shown_images_[eye] = sample.cameras[eye]->image;
    shown_stamps_ns_[eye] = sample.cameras[eye]->stamp_ns;
  }
}

// An image is shown for several frames, and by a single camera to both eyes: it counts once.
void RunTracker::sampled(const FrameSample& sample) {
  const auto before = shown_images_;
  show(sample);
  for (std::size_t eye = 0; eye < shown_images_.size(); ++eye) {
    const bool counted =
        shown_images_[eye] == before[eye] || (eye == 1 && shown_images_[1] == shown_images_[0]);
    if (!counted) sanitised_values_ += shown_images_[eye]->sanitised_values;
  }
}

void RunTracker::frame_done() {
  ++state_.next_frame;
  state_.renderer = renderer_.state(false);
  state_.camera_stamps_ns = shown_stamps_ns_;
  state_.sanitised_camera_values = sanitised_values_;
  const SessionFindings& found = session_.findings();
  state_.skipped_images += found.skipped_images - skipped_before_;
  skipped_before_ = found.skipped_images;
  for (; warnings_before_ < found.warnings.size(); ++warnings_before_) {
    state_.warnings.push_back(found.warnings[warnings_before_]);
  }
}

RunState RunTracker::whole_state() const {
  RunState state = state_;
  state.renderer.probes = renderer_.state().probes;
  return state;
}

SessionFindings RunTracker::findings() const {
  SessionFindings findings = opened_;
  findings.skipped_images += state_.skipped_images;
  findings.warnings.insert(findings.warnings.end(), state_.warnings.begin(), state_.warnings.end());
  return findings;
}

}  // namespace herr
