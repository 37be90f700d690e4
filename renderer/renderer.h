// The renderer core: pose + gaze + camera + scene state -> four composited viewports + stage times.
// No I/O here; the server hands in what it read and writes what comes out.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/frame_counters.h"
#include "renderer/frame_plan.h"
#include "renderer/further_view.h"
#include "renderer/memory_use.h"
#include "renderer/pixel_pass.h"
#include "renderer/probe_counts.h"
#include "renderer/render_settings.h"
#include "renderer/stage_times.h"
#include "renderer/viewport_image.h"
#include "scenes/model/scene.h"
#include "sessions/format/display_profile.h"
#include "sessions/streams/frame_sample.h"

namespace herr {

class ProbeReader;  // probes/probe_reader.h

// What may change from frame to frame. No choice of it allocates.
struct FrameQuality {
  int light_samples = 1;  // per light and hit, 1 ... 4096
  // Radial samples per eye, 1 ... as many as the settings say; 0: that many. With polar_acuity those of the
  // eye that needs more, up to its need; the other eye has the same share of its own need.
  int polar_width = 0;
  int probes = 0;  // updated at most, of those that the settings' budget allows; 0: as many as it does
  // Angular samples, an even number up to that of the settings; 0: that many.
  int polar_height = 0;
};

// One rendered frame. Reuse it for every frame: its storage is kept.
struct RenderedFrame {
  std::vector<ViewportImage> viewports;  // in the order of DisplayProfile::viewports
  std::vector<FurtherView> further;      // as further_views() lists them; empty unless asked for
  StageTimes times;
  FrameCounters counters;
  FrameQuality quality;                   // of this frame, every number resolved; probes 0 without probes
  ProbeCounts probes;                     // all 0 without probes
  std::array<double, 2> theta_max_deg{};  // per eye: from this frame's gaze to the farthest viewport border
  std::optional<double> cpu_ms;  // of all threads of the process meanwhile (cpu_use.h); none: not told
  std::optional<std::int64_t> preemptions;  // of all threads of the process meanwhile; none: not told
  std::array<int, 2> polar_width{};         // per eye: columns of the polar buffer; 0 without
  int polar_height = 0;                     // rows

  // As pictures_of_frame() lists them; they stay this frame's.
  std::vector<const ViewportImage*> pictures() const;
};

// What a frame leaves behind for the next one, beyond buffers that are filled anew: with it a replay goes on
// in the middle as if it had come from the start. Stages that carry state keep it here.
struct RendererState {
  std::optional<glm::dvec3> anchor;  // metres, on steps of 16 m or less; none before the first frame
  std::vector<std::byte> probes;     // what probes have gathered; empty without probes
  std::vector<std::byte> details;    // which form of each mesh is shown; empty without coarser forms
};

// Thread safety: one thread calls; the renderer runs its own workers. Throws
// std::runtime_error when Embree fails.
class Renderer {
 public:
  // Builds the acceleration structures. `scene` must outlive the renderer; it may change between frames as
  // the SceneState says that is handed to each.
  Renderer(const Scene& scene, const DisplayProfile& profile, const RenderSettings& settings,
           bool session_has_camera);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  const FramePlan& plan() const;
  const RenderSettings& settings() const;  // threads and isa resolved to what runs
  int threads() const;
  MemoryUse memory() const;           // as of now; of the plan's parts those left out hold 0 bytes
  FrameQuality full_quality() const;  // what a frame has at most
  // What the frame of `sample` has when nothing less is asked for; below the above with polar_acuity alone.
  FrameQuality full_quality(const FrameSample& sample) const;

  // With the quality that the settings ask for, or one of this frame's own. A width or height
  // below that of the settings gives the bytes that a renderer built for it gives. `abandon` (may be null) is
  // asked before each tile and strip: once it is set the frame is given up, the answer is false and `out` is
  // no picture. True: the frame is whole. Throws std::invalid_argument for a head pose or a quality out of
  // range.
  bool render_frame(const FrameSample& sample, const SceneState& state, RenderedFrame& out,
                    const std::atomic<bool>* abandon = nullptr);
  bool render_frame(const FrameSample& sample, const SceneState& state, const FrameQuality& quality,
                    RenderedFrame& out, const std::atomic<bool>* abandon = nullptr);

  // A frame of the settings' quality with the random numbers and rays of `pass`. Probes stay as the last
  // frame left them. Throws std::invalid_argument for jitter or tiles with foveation, or at a scale below 1,
  // and for another number of tiles.
  void render_pass(const FrameSample& sample, const SceneState& state, const PixelPass& pass,
                   RenderedFrame& out);
  // Without foveation: how a frame is divided; empty with it.
  std::vector<PixelTile> pixel_tiles() const;

  // What frames from here on are shown with, in place of the settings' exposure; settings() names it. The
  // camera feed's white is 2^-ev then: pictures times the exposure show the feed as it was taken.
  void set_exposure(double ev);

  // Takes up what a frame changes in the renderer's state without rendering it.
  void skip_frame(const FrameSample& sample, const SceneState& state);
  // After the last frame, whole or skipped. An abandoned frame has changed it too.
  // `with_probes`: megabytes; without them the rest, which costs nothing to ask for after each frame.
  RendererState state(bool with_probes = true) const;
  // Throws std::invalid_argument when the probes' bytes belong to another version, scene or grid; then this
  // renderer is of no use any more.
  void restore(const RendererState& state);
  // As if no frame had been rendered: the next one is, bit for bit, the first of a renderer built on the
  // scene as it is now, and its counters tell of no instance. `state`: of the scene now. Memory that a plan
  // once needed stays. Not between two frames of one run: it may allocate.
  void restart(const SceneState& state);
  // The probes as of the last frame, to be read before the next one; none without probes.
  std::optional<ProbeReader> probes() const;

  // Runs `work(i)` for i in [0, count) on the render threads (encoders use this between frames).
  void parallel_for(int count, const std::function<void(int)>& work);

  // What lies behind, for bench_frame.cpp and tests of single stages; declared in renderer_impl.h.
  struct Impl;
  Impl& internals() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace herr
