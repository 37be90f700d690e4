// What a replay carries from frame to frame, so that it can go on in the middle as if it had come from the
// start. Pictures depend on two things of the past: the renderer's state, and which camera image was the
// last that decoded. A stage with state of its own adds it to RendererState. (Gaze, pose and scene depend on
// the time alone.) Before: the replay loop tells of each frame. After: checkpoint.json.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/renderer.h"
#include "sessions/session.h"

namespace herr {

// After the frames before next_frame.
struct RunState {
  std::int64_t next_frame = 0;
  RendererState renderer;
  std::array<std::optional<TimeNs>, 2> camera_stamps_ns;  // per eye: of the camera image shown last
  // Found since the first frame; what was found when the session was opened is not among them.
  std::int64_t sanitised_camera_values = 0, skipped_images = 0;
  std::vector<std::string> warnings;
};

// Not thread-safe. Session and renderer must outlive it.
class RunTracker {
 public:
  // At the start of a run; the session was opened and not yet sampled.
  RunTracker(Session& session, Renderer& renderer, std::int64_t first_frame);
  // Brings session and renderer to where they were after the frame at `last_frame_ns` (none: before the first
  // one). Call before sampling. Throws what Session::sample throws.
  void restore(const RunState& state, std::optional<TimeNs> last_frame_ns);

  // For each frame in turn: its sample, then that it is whole. A frame that is given up in between leaves no
  // trace in state().
  void sampled(const FrameSample& sample);
  void frame_done();

  const RunState& state() const { return state_; }  // without what probes have gathered
  // With it, for checkpoints. (A frame that was given up has updated the probes; when it is rendered again it
  // does not do so twice.)
  RunState whole_state() const;
  SessionFindings findings() const;  // on opening and since

 private:
  void show(const FrameSample& sample);

  Session& session_;
  Renderer& renderer_;
  const SessionFindings opened_;
  RunState state_;
  std::int64_t sanitised_values_ = 0;
  // How many of the session's findings were there before this run: from opening it, and from restoring.
  std::int64_t skipped_before_;
  std::size_t warnings_before_;
  std::array<std::shared_ptr<const CameraImage>, 2> shown_images_;
  std::array<std::optional<TimeNs>, 2> shown_stamps_ns_;
};

}  // namespace herr
