// What a renderer keeps between frames. Everything is allocated at construction: the
// frame loop allocates nothing.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "renderer/detail/detail_levels.h"
#include "renderer/direct_light/light_records.h"
#include "renderer/environment/filtered_environment.h"
#include "renderer/foveation/ray_grids.h"
#include "renderer/geometry/embree_scene.h"
#include "renderer/geometry/instance_boxes.h"
#include "renderer/outside/outside_work.h"
#include "renderer/probe_updates/probe_job.h"
#include "renderer/probes/probe_motion.h"
#include "renderer/renderer.h"
#include "renderer/threads/render_threads.h"
#include "renderer/tiles/tile_job.h"
#include "renderer/viewports/blended_view.h"
#include "renderer/viewports/viewport_job.h"

namespace herr {

// What is particular to one call: all null for an ordinary frame.
struct FrameUse {
  const PixelPass* pass = nullptr;
  const std::atomic<bool>* abandon = nullptr;
};

struct Renderer::Impl {
  Impl(const Scene& scene, const DisplayProfile& profile, const RenderSettings& settings,
       bool session_has_camera);

  const Scene& scene;  // of which it looks again at what SceneState::changes names
  DisplayProfile profile;
  RenderSettings settings;  // threads and isa resolved
  FramePlan plan;
  RenderThreads threads;
  std::unique_ptr<EmbreeScene> geometry;
  DetailLevels details;
  std::array<DetailEye, 2> detail_eyes;
  InstanceBoxes boxes;
  std::unique_ptr<FilteredEnvironment> filtered_environment;  // where the plan has one
  bool session_has_camera = false;
  double beyond_scene_m = 1;  // leaves the scene from any place in it

  TraceTile trace_tile;
  CompositeStrip composite_strip;
  BlendStrip blend_strip;

  // Per frame, rewritten in place.
  std::array<EyeView, 2> eyes;
  std::array<std::unique_ptr<PolarSamples>, 2> samples;    // per eye, log-polar only
  std::array<std::unique_ptr<EdgePlaces>, 2> edge_places;  // likewise, with edge samples
  std::vector<RadianceBuffer> buffers;                     // per eye, or per viewport without foveation
  std::vector<RayGrid> grids;                              // one per buffer
  std::vector<int> first_tile;                             // of each grid, then the total
  std::vector<std::uint8_t> covered_tiles;                 // 1: not traced; empty where all are
  std::vector<LightRecord> lights;
  std::vector<ShadingPoints> light_points;  // one of each light
  ShadingInputs shading;
  std::vector<ViewportJob> viewport_jobs;     // one per viewport
  std::vector<int> first_strip;               // of each viewport, then the total
  std::array<FeedInScene, 2> feeds;           // per eye
  std::array<CameraImage, 2> enlarged_feeds;  // copies of images too small for a bilinear fetch

  // Of the pictures beside the viewports, as further_views() lists them.
  std::vector<PictureOutline> further;
  std::vector<BlendedView> blended_views;
  std::unique_ptr<OutsideWork> outside_work;

  // With probes only.
  std::unique_ptr<ProbeVolume> probes;
  std::unique_ptr<ProbeMotion> probe_motion;  // where the scene changes
  ProbeKernels probe_kernels{};
  FramePlan probe_plan;                        // of what probe rays hit: one light sample, nothing invisible
  std::array<ProbeView, 2> probe_views;        // all geometry; catchers alone
  std::array<ShadingInputs, 2> probe_shading;  // likewise
  std::vector<LightRecord> probe_lights;       // one sample each
  std::vector<LightRecord> real_probe_lights;  // of these, those that are not virtual
  std::vector<std::vector<ProbeLanes>> probe_radiance;  // per worker

  // Per worker.
  std::vector<std::unique_ptr<TileScratch>> tile_scratch;
  std::vector<std::unique_ptr<StripScratch>> strip_scratch;
  std::vector<BlendScratch> blend_scratch;  // with blended views only
  std::vector<TileCounters> counters;
  std::vector<StageCycles> cycles;

  // The stages of a frame, in order (render_frame.cpp). False: it was given up.
  bool render(const FrameSample& sample, const SceneState& state, const FrameQuality& quality,
              const FrameUse& use, RenderedFrame& out);
  void follow_gaze(const FrameSample& sample);
  SceneUpdate update_acceleration(const FrameSample& sample, const SceneState& state);
  void place_eyes(const FrameSample& sample);  // parts of update_acceleration: these three
  void show_full_details();
  void choose_details();
  LightReach light_reach() const;  // of lights, for this frame
  void update_scene(const SceneState& state, const FrameQuality& quality);
  void update_lights(const SceneState& state, const FrameQuality& quality);
  void update_probes(const FrameSample& sample, const SceneState& state, RenderedFrame& out);
  // Columns at this frame's full quality: of an eye, of the eye that needs the most; of an eye where that one
  // has `polar_width`.
  int full_width(double theta_max_deg) const;
  int full_width() const {
    return std::max(full_width(eyes[0].theta_max_deg), full_width(eyes[1].theta_max_deg));
  }
  int width_of(const EyeView& eye, int polar_width) const;
  // An eye without viewports has a map, too.
  static PolarMap polar_map(double theta_max_deg) { return PolarMap::up_to(std::max(theta_max_deg, 1e-3)); }
  void set_up_feeds(const FrameSample& sample);
  void set_up_rays(const FrameSample& sample, const FrameQuality& quality, const PixelPass* pass);
  bool trace_tiles(StageTimes& times, const FrameUse& use);
  void set_up_viewports(RenderedFrame& out);
  bool composite_viewports(StageTimes& times, const std::atomic<bool>* abandon);
  bool draw_overlays(RenderedFrame& out, const std::atomic<bool>* abandon);  // overlays.cpp; so is this one
  bool draw_density(RenderedFrame& out, const std::atomic<bool>* abandon);
  void collect_counters(RenderedFrame& out) const;
  void paint_see_through(const ShownColour& colour, ShadingInputs& inputs) const;

  // After the frame (further_views.cpp). False: it was given up.
  void build_further_views();
  bool make_further_views(const FrameSample& sample, RenderedFrame& out, const std::atomic<bool>* abandon);
  void set_up_further_views(RenderedFrame& out) const;
  bool blend_views(RenderedFrame& out, const std::atomic<bool>* abandon);
  bool render_outside(const FrameSample& sample, RenderedFrame& out, const std::atomic<bool>* abandon);
  void set_up_outside(const FrameSample& sample, const Pose& anchored_from_camera);
  void set_up_overlay(const FrameSample& sample, const PictureCamera& camera);

  // What follows from the instances that are there (changed_scene.cpp).
  void measure_reach();
  bool replan();
  bool follow(const SceneUpdate& update, const SceneState& state);
  void restart(const SceneState& state);
  void allocate_buffers();  // frame_memory.cpp
  void allocate_scratch();
  void filter_environment();
  std::vector<PixelTile> pixel_tiles() const;  // pixel_tiles.cpp
  void find_covered_tiles();
  void run_tile(int job, int worker, RayRecorder* recorder);
  void build_probes();
  void place_for_probes();
  void plan_probes();
  void publish_probes();
  std::vector<std::byte> save_probes() const;
  void restore_probes(std::span<const std::byte> bytes);
  void aim_probes(const FrameSample& sample, const SceneState& state, int most);
  void view_probes();
  std::int64_t probe_bytes() const;
  int most_probes() const { return probes ? probes->most_updated() : 0; }
  int probe_job_count() const { return probes->job_count() * static_cast<int>(probes->sets.size()); }
  ProbeJob probe_job(int job, int worker, RayRecorder* recorder);
  float shown_scale() const { return Exposure{false, settings.exposure_ev.value_or(0)}.scale(); }
  int tile_count() const { return first_tile.back(); }
  int buffer_of(std::size_t viewport) const {
    return plan.polar ? static_cast<int>(profile.viewports[viewport].eye) : static_cast<int>(viewport);
  }
};

}  // namespace herr
