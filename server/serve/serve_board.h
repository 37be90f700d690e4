// What the frame loop shows to the outside: snapshots that never change once they are published. Readers take
// a reference under a lock that is held for the copy of a pointer; the loop never waits for them.
// Before: frame_loop publishes. After: endpoints read.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "renderer/renderer.h"
#include "server/results/session_report.h"
#include "server/statistics/recent_frames.h"
#include "server/statistics/run_statistics.h"

namespace herr {

enum class ServePhase { starting, running, stopping };
const char* name_of(ServePhase phase);

struct ServeSnapshot {
  ServePhase phase = ServePhase::starting;
  TimeNs started_ns = 0, taken_ns = 0;           // steady clock
  std::shared_ptr<const SessionReport> subject;  // what is replayed; its statistics are empty; none at first
  std::int64_t lap = 0;                          // how often all sessions were replayed
  std::int64_t frame = 0;                        // number of the newest frame in its session
  std::int64_t rendered = 0;                     // in all: the sequence of the newest frame; 0: none yet
  std::vector<RecentFrame> recent;               // oldest first
  RunStatistics run;                             // since the start
  MemoryUse memory;                              // of renderer, scene and pictures, encoders aside
};

// The pictures of one frame.
struct ServedPictures {
  std::int64_t sequence = 0;
  bool coverage = false;  // no camera feed is behind the pictures: alpha counts
  std::shared_ptr<const SessionReport> subject;
  RenderedFrame frame;
  std::array<ViewportImage, 2> polar;  // thinned polar buffers per eye, where somebody looks at them
  bool has_polar = false;
};

// Thread-safe.
template <typename T>
class Latest {
 public:
  std::shared_ptr<const T> get() const {
    const std::lock_guard lock(mutex_);
    return value_;
  }
  // The old value is let go outside the lock.
  void set(std::shared_ptr<const T> value) {
    const std::lock_guard lock(mutex_);
    value_.swap(value);
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const T> value_;
};

struct ServeBoard {
  Latest<ServeSnapshot> snapshot;  // never empty once a loop or command exists
  Latest<ServedPictures> pictures;
  // When somebody last asked for a polar buffer; steady clock. They are copied for a while after that.
  mutable std::atomic<TimeNs> polar_asked_ns{std::numeric_limits<TimeNs>::min() / 2};
};

}  // namespace herr
