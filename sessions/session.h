// A recorded session, opened and checked, and what the headset knew at a frame's time.
// Before: a folder in format version 1 (format/README.md). After: renderer/ and server/.
// Streams are read as they are needed: memory does not grow with the length of the recording.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "sessions/check/session_findings.h"
#include "sessions/format/session_header.h"
#include "sessions/streams/frame_sample.h"
#include "sessions/streams/scene_event.h"
#include "sessions/streams/session_options.h"

namespace herr {

// Not thread-safe: one caller samples, with times that never decrease.
class Session {
 public:
  // Opens a folder and checks every row of every stream and every camera file's header. Throws InputError.
  static Session open(const std::filesystem::path& folder, const SessionOptions& options = {});
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  const SessionHeader& header() const;
  const SessionFindings& findings() const;
  const std::filesystem::path& folder() const;
  // The span that can be replayed: from the first pose to the last (or as the header
  // narrows it). end >= start.
  TimeNs start_ns() const;
  TimeNs end_ns() const;

  // State at t_ns (start_ns() <= t_ns). Throws InputError when a camera frame does not decode (unless
  // keep_going: then the previous frame is held) and std::logic_error when time runs backwards.
  FrameSample sample(TimeNs t_ns);
  // Events with stamps in (previous call's t_ns, t_ns].
  std::vector<SceneEvent> events_until(TimeNs t_ns);
  // The next one of them, or none up to t_ns: many may precede a late start.
  std::optional<SceneEvent> next_event(TimeNs t_ns);
  // All events from the first, read anew; this session's own reading is not moved. Throws InputError.
  void visit_events(const std::function<void(const SceneEvent&)>& visit) const;
  // Where lines of events come from, for messages.
  std::filesystem::path events_file() const;

 private:
  struct State;
  explicit Session(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace herr
