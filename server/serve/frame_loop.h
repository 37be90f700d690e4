// The loop of `herr serve`: replays the sessions over and over by one of the three clocks and publishes what
// it knows after each frame. Before: serve_command. After: ServeBoard.
#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include "server/frames/frame_step.h"
#include "server/serve/recycler.h"
#include "server/serve/serve_board.h"
#include "server/settings/replay_options.h"

namespace herr {

// Times in what it publishes are those of steady_now_ns(). Used by one thread; the
// board's readers are others.
class FrameLoop {
 public:
  // `stop` is asked before each frame, while waiting for one and between the tiles of one.
  // All must outlive the loop.
  FrameLoop(const ReplayOptions& options, ServeBoard& board, const std::atomic<bool>& stop);

  // Until `stop` says so. Throws what opening and sampling a session throws; what was published stays.
  void run();
  // Says on the board that the server ends.
  void announce_end();

  const ServeSnapshot& state() const { return state_; }

 private:
  void open(const std::filesystem::path& folder);
  void replay_lap();
  void replay_paced();
  void render(std::int64_t frame, FramePacing pacing);
  void note_memory(const ServedPictures& pictures);
  void publish(bool at_once);

  const ReplayOptions& options_;
  ServeBoard& board_;
  const std::atomic<bool>& stop_;
  std::filesystem::path opened_folder_;
  std::unique_ptr<OpenedSession> opened_;
  std::shared_ptr<const SessionReport> subject_;
  std::optional<FrameStep> step_;  // of the opened session and subject
  Recycler<ServedPictures> picture_storage_;
  Recycler<ServeSnapshot> snapshot_storage_;
  ServeSnapshot state_;  // its `recent` stays empty: recent_ has them
  RecentFrames recent_;
  TimeNs published_ns_ = 0;
  std::int64_t dropped_at_end_ = 0;
};

}  // namespace herr
