// The figure of merit: a frame's time against its bare time ("raw" in tables and JSON) - the same rays
// through bare Embree packets and the same pixels through a bare fetch-blend-store kernel, measured frame by
// frame in the same run on the same threads.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/renderer.h"

namespace herr {

// The frames that are measured, in order: a sequence that can begin again.
class BenchSequence {
 public:
  virtual ~BenchSequence() = default;
  virtual int frames() const = 0;  // 1 or more
  // As if no frame had been rendered: the same frames follow, bit for bit.
  virtual void rewind() = 0;
  // Frame `index`, one more than the last time, or 0 at the start and after rewind().
  virtual void render(int index, RenderedFrame& out) = 0;
};

struct BenchResult {
  struct Kind {
    std::string name;              // "primary", "shadow", ...
    std::int64_t rays = 0;         // of all frames, per frame on average
    double rays_per_sample = 0;    // per polar sample that a viewport can see
    double bare_mrays_per_s = 0;   // through bare Embree
    double frame_mrays_per_s = 0;  // within the frame: rays over their stage's wall time
  };
  int frames = 0;
  double frame_ms = 0, bare_ms = 0;                // medians over frames of each frame's median
  double rays_frame_ms = 0, rays_bare_ms = 0;      // all stages of rays and light; bare rays
  double pixels_frame_ms = 0, pixels_bare_ms = 0;  // resample and composite; bare kernel
  double ratio = 0, rays_ratio = 0;                // medians over frames of frame / bare, interleaved
  std::vector<Kind> kinds;
  std::optional<double> cpu_ms;  // CPU time of the process during a frame, as frame_ms; none: not told
  double ns_per_pixel = 0, bare_ns_per_pixel = 0;
  StageTimes median_times;
  FrameCounters counters;            // of all measured frames together
  int measured_frames = 0;           // frames x repeats
  FramePlan plan;                    // with each trait that the plan of some frame had
  std::int64_t picture_bytes = 0;    // that the pictures of a frame hold
  std::int64_t most_probe_rays = 0;  // of a frame that updates every probe its budget allows, each set
};

// A run of a given length, as the paper's Table 1 averages it.
struct BenchRun {
  int frames = 0;
  double frame_ms = 0, bare_ms = 0;  // means over the frames
  double probe_ms = 0;               // likewise: the stages that update probes
  std::optional<double> cpu_ms;      // likewise: CPU time of the process during a frame; none: not told
  std::int64_t picture_bytes = 0;    // that the pictures of a frame hold
  double ratio() const { return bare_ms > 0 ? frame_ms / bare_ms : 0; }
};

// Renders the whole sequence again and again, after one frame that warms up, until the frame times sum up to
// `seconds`; each frame's bare side is recorded and timed right after it. The sequence renders with
// `renderer`. Thread safety: as Renderer.
BenchRun bench_run(Renderer& renderer, BenchSequence& sequence, double seconds);

// Renders the whole sequence once to warm up, then `repeats` times; after each frame 1/16 of its tiles (1/256
// from 64 light samples on) are recorded and its bare side is timed. Thread safety: as Renderer.
BenchResult bench_frames(Renderer& renderer, BenchSequence& sequence, int repeats);

}  // namespace herr
