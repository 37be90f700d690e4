// A frame, stage by stage (paper, Figure 4). Read this page first.
// sample of the session -> gaze -> acceleration structures follow the head ->
// lights -> probes -> polar rays -> first hits, light rays, second rays (tile by tile) -> viewports over the
// camera feed -> overlays. No I/O, no allocation, no lock.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

#include "renderer/broken_on_purpose.h"
#include "renderer/direct_light/light_records.h"
#include "renderer/frame/renderer_impl.h"
#include "renderer/threads/cpu_use.h"
#include "renderer/tiles/finite_lanes.h"

namespace herr {
namespace {

using SteadyClock = std::chrono::steady_clock;

double milliseconds_since(SteadyClock::time_point start) {
  return std::chrono::duration<double, std::milli>(SteadyClock::now() - start).count();
}

std::optional<double> cpu_ms_since(std::optional<std::int64_t> start_ns) {
  const std::optional<std::int64_t> now_ns = process_cpu_ns();
  if (!start_ns || !now_ns) return std::nullopt;
  return static_cast<double>(*now_ns - *start_ns) * 1e-6;
}

std::optional<std::int64_t> preemptions_since(std::optional<std::int64_t> start) {
  const std::optional<std::int64_t> now = process_preemptions();
  if (!start || !now) return std::nullopt;
  return *now - *start;
}

// Runs one serial stage and books its time.
template <typename Work>
auto timed(StageTimes& times, Stage stage, Work&& work) {
  const auto start = SteadyClock::now();
  struct Book {
    StageTimes& times;
    Stage stage;
    SteadyClock::time_point start;
    ~Book() { times[stage] += milliseconds_since(start); }
  } book{times, stage, start};
  return work();
}

void require_usable(const Pose& pose) {
  constexpr double kFarthest_m = 1e9;  // as rows of a session are checked
  const glm::dvec3& p = pose.position;
  const glm::dquat& q = pose.orientation;
  const bool usable = std::abs(p.x) < kFarthest_m && std::abs(p.y) < kFarthest_m &&
                      std::abs(p.z) < kFarthest_m &&
                      std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1.0) < 1e-3;
  if (!usable) throw std::invalid_argument("head pose is not finite, not a rotation, or farther than 1e9 m");
}

// With numbers in place of "as the settings say".
FrameQuality resolved(FrameQuality quality, const RenderSettings& settings, int most_probes) {
  if (quality.light_samples < 1 || quality.light_samples > kMostLightSamples) {
    throw std::invalid_argument("light samples of a frame must lie in [1, 4096]");
  }
  if (quality.polar_width < 0 || quality.polar_width > settings.polar_width) {
    throw std::invalid_argument("polar width of a frame must lie in [1, " +
                                std::to_string(settings.polar_width) + "]");
  }
  if (quality.polar_height < 0 || quality.polar_height % 2 != 0 ||
      quality.polar_height > settings.polar_height) {
    throw std::invalid_argument("polar height of a frame must be even and lie in [2, " +
                                std::to_string(settings.polar_height) + "]");
  }
  if (quality.probes < 0) throw std::invalid_argument("probes of a frame must be 0 or more");
  if (quality.polar_width == 0) quality.polar_width = settings.polar_width;
  if (quality.polar_height == 0) quality.polar_height = settings.polar_height;
  if (quality.probes == 0 || quality.probes > most_probes) quality.probes = most_probes;
  return quality;
}

void count(const SceneUpdate& update, FrameCounters& counters) {
  counters.commits = update.commits;
  counters.instances_moved = update.moved;
  counters.instances_spawned = update.spawned;
  counters.instances_removed = update.removed;
  counters.instances_restyled = update.restyled;
  counters.meshes_refitted = update.refitted;
  counters.meshes_rebuilt = update.rebuilt;
}

// Debug builds: no pixel is NaN or infinite.
void require_finite_viewports(const RenderedFrame& frame) {
  if constexpr (!kStagesAreChecked) return;
  for (const ViewportImage& image : frame.viewports) {
    for (int y = 0; y < image.height_px; ++y) {
      const std::span row(image.row(y), 4 * static_cast<std::size_t>(image.width_px));
      require_none(Stage::viewports, first_not_finite(row, "row " + std::to_string(y)));
    }
  }
}

}  // namespace

bool Renderer::render_frame(const FrameSample& sample, const SceneState& state, RenderedFrame& out,
                            const std::atomic<bool>* abandon) {
  return render_frame(sample, state, full_quality(), out, abandon);
}

bool Renderer::render_frame(const FrameSample& sample, const SceneState& state, const FrameQuality& quality,
                            RenderedFrame& out, const std::atomic<bool>* abandon) {
  return impl_->render(sample, state, quality, {nullptr, abandon}, out);
}

void Renderer::render_pass(const FrameSample& sample, const SceneState& state, const PixelPass& pass,
                           RenderedFrame& out) {
  Impl& impl = *impl_;
  const bool by_pixels = pass.jitter || !pass.tiles.empty();
  if (by_pixels && (impl.plan.polar || impl.settings.scale < 1)) {
    throw std::invalid_argument("passes over single pixels or tiles need --foveation off and --scale 1");
  }
  if (!pass.tiles.empty() && pass.tiles.size() != impl.pixel_tiles().size()) {
    throw std::invalid_argument("a pass needs one byte for each of the frame's tiles");
  }
  impl.render(sample, state, full_quality(), {&pass, nullptr}, out);
}

bool Renderer::Impl::render(const FrameSample& sample, const SceneState& state, const FrameQuality& quality,
                            const FrameUse& use, RenderedFrame& out) {
  Impl& impl = *this;
  require_usable(sample.head.world_from_head);
  out.quality = resolved(quality, impl.settings, impl.most_probes());
  out.times = {};
  out.counters = {};
  std::fill(impl.counters.begin(), impl.counters.end(), TileCounters{});
  const auto start = SteadyClock::now();
  const std::optional<std::int64_t> cpu_start_ns = process_cpu_ns();
  const std::optional<std::int64_t> preemptions_at_start = process_preemptions();

  timed(out.times, Stage::polar_rays, [&] { impl.follow_gaze(sample); });
  out.quality.polar_width = std::min(out.quality.polar_width, impl.full_width());
  const SceneUpdate update =
      timed(out.times, Stage::acceleration, [&] { return impl.update_acceleration(sample, state); });
  count(update, out.counters);
  out.times.commit_ms = update.commit_ms;
  if (update.anything() &&
      timed(out.times, Stage::scene_update, [&] { return impl.follow(update, state); })) {
    out.counters.plan_changes = 1;
  }
  timed(out.times, Stage::scene_update, [&] { impl.update_scene(state, out.quality); });
  if (impl.plan.probes && use.pass) impl.view_probes();
  if (impl.plan.probes && !use.pass) impl.update_probes(sample, state, out);
  timed(out.times, Stage::viewports, [&] { impl.set_up_feeds(sample); });
  timed(out.times, Stage::polar_rays, [&] { impl.set_up_rays(sample, out.quality, use.pass); });
  if (!impl.trace_tiles(out.times, use)) return false;
  timed(out.times, Stage::viewports, [&] { impl.set_up_viewports(out); });
  if (!impl.composite_viewports(out.times, use.abandon)) return false;
  require_finite_viewports(out);
  if (!impl.draw_overlays(out, use.abandon)) return false;

  // Within the wall time, so that it is never more than that on every core.
  out.cpu_ms = cpu_ms_since(cpu_start_ns);
  out.preemptions = preemptions_since(preemptions_at_start);
  out.times.frame_ms = milliseconds_since(start);
  double booked = 0;
  for (const double ms : out.times.ms) booked += ms;
  out.times[Stage::other] = std::max(0.0, out.times.frame_ms - booked);
  impl.collect_counters(out);

  // Beside what the headset shows: not of the frame time.
  const auto finished = SteadyClock::now();
  if (!impl.make_further_views(sample, out, use.abandon)) return false;
  if (!out.further.empty()) out.times.views_ms = milliseconds_since(finished);
  return true;
}

void Renderer::skip_frame(const FrameSample& sample, const SceneState& state) {
  require_usable(sample.head.world_from_head);
  impl_->follow_gaze(sample);
  const SceneUpdate update = impl_->update_acceleration(sample, state);
  if (update.anything()) impl_->follow(update, state);
  if (!impl_->plan.probes) return;
  RenderedFrame nobodys;
  nobodys.quality = full_quality();
  impl_->update_scene(state, nobodys.quality);
  impl_->update_probes(sample, state, nobodys);
}

void Renderer::Impl::place_eyes(const FrameSample& sample) {
  const Pose world_from_head = scene.world_from_session * sample.head.world_from_head;
  geometry->follow(world_from_head.position);
  for (std::size_t e = 0; e < eyes.size(); ++e) {
    eyes[e].anchored_from_eye = world_from_head * sample.head_from_eye[e];
    eyes[e].anchored_from_eye.position -= geometry->anchor();
  }
}

SceneUpdate Renderer::Impl::update_acceleration(const FrameSample& sample, const SceneState& state) {
  SceneUpdate update;
  place_eyes(sample);
  geometry->apply(state, update);
  if (update.other_traits()) show_full_details();
  geometry->bend(state, threads);
  if (plan.detail_levels) choose_details();
  const auto commit = [&] {
    const auto start = SteadyClock::now();
    geometry->commit_changes(update);
    if (update.commits > 0) update.commit_ms = milliseconds_since(start);
  };
  threads.inside(std::cref(commit));  // by reference: the capture would not fit in std::function
  return update;
}

// Which instances have a choice is measured anew; the full mesh stands there until the next choice.
void Renderer::Impl::show_full_details() {
  details.measure_anew([this](std::size_t i, std::uint32_t mesh) { geometry->show_mesh(i, mesh); });
}

void Renderer::Impl::choose_details() {
  for (const Eye eye : kEyes) {
    const auto e = static_cast<std::size_t>(eye);
    const Pose& pose = eyes[e].anchored_from_eye;
    detail_eyes[e].position = pose.position + geometry->anchor();
    detail_eyes[e].gaze = pose.orientation * eyes[e].gaze.gaze;
    detail_eyes[e].foveated = plan.polar;
    const double theta_max_deg = eyes[e].theta_max_deg;
    if (!plan.polar) continue;
    detail_eyes[e].samples_per_deg = polar_map(theta_max_deg).radial_density(0.0, full_width(theta_max_deg));
  }
  details.choose(
      detail_eyes, settings.detail_error,
      [this](std::size_t i) -> const glm::dmat4x3& { return scene.instances[i].world_from_object; },
      [this](std::size_t i, std::uint32_t mesh) { geometry->show_mesh(i, mesh); });
}

void Renderer::Impl::update_scene(const SceneState& state, const FrameQuality& quality) {
  update_lights(state, quality);
  shading.plan = &plan;
  shading.scene = geometry->top();
  shading.instances = geometry->instances();
  shading.occlusion_rays = settings.occlusion_rays;
  shading.occlusion_radius_m = static_cast<float>(settings.occlusion_radius_m);
  shading.occlusion_smoothing = settings.occlusion_smoothing;
  const EnvironmentImage& outside = scene.environment_map;
  const float turn = outside.turn_deg / 360.0f;
  shading.environment_map = {outside.rgba.empty() ? nullptr : outside.rgba.data(), outside.width_px,
                             outside.height_px, turn - std::floor(turn)};
  shading.filtered =
      filtered_environment ? filtered_environment->record(turn - std::floor(turn)) : FilteredRecord{};
  constexpr float kDarkest = 1e-4f;  // of the light on the farthest catcher: below it a ratio is noise
  const glm::vec3 scale =
      plan.catchers ? farthest_irradiance(state.lights, boxes.catchers()) : glm::vec3{0.0f};
  for (int channel = 0; channel < 3; ++channel) {
    shading.ambient[channel] = scene.ambient[channel];
    shading.environment[channel] = scene.environment[channel];
    shading.smallest_irradiance[channel] = kDarkest * scale[channel];
  }
  shading.paints_see_through = settings.see_through_colour.has_value();
  if (shading.paints_see_through) paint_see_through(*settings.see_through_colour, shading);
  // An overlay without a feed darkens by its coverage: it cannot make brighter what lies behind it.
  shading.largest_ratio =
      plan.virtual_lights && !settings.camera && !shading.paints_see_through ? 1.0f : kLargestRatio;
  shading.background_is_environment = !plan.camera && settings.camera;
  shading.debug_tiles = settings.debug_tiles;
  shading.shown_white = 1.0f / shown_scale();
}

void Renderer::Impl::set_up_rays(const FrameSample& sample, const FrameQuality& quality,
                                 const PixelPass* pass) {
  const std::uint32_t seed = pass ? pass->seed : settings.seed;
  first_tile[0] = 0;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const auto eye = plan.polar ? static_cast<Eye>(i) : profile.viewports[i].eye;
    const EyeView& view = eyes[static_cast<std::size_t>(eye)];
    const std::uint32_t key = frame_key(sample.t_ns - sample.start_ns, static_cast<int>(eye), seed);
    if (plan.polar) {
      samples[i]->update(polar_map(view.theta_max_deg), width_of(view, quality.polar_width),
                         quality.polar_height, pass ? pass->cell : CellPlace{});
      set_polar_grid(view, profile.viewports, eye, *samples[i], buffers[i], key, grids[i]);
      grids[i].edge_places = edge_places[i].get();
      if (edge_places[i]) {
        edge_places[i]->update(samples[i]->map(), samples[i]->width(), quality.polar_height);
      }
    } else {
      set_planar_grid(view, profile.viewports[i], settings.scale, buffers[i], key, grids[i]);
    }
    const FeedInScene& feed = feeds[static_cast<std::size_t>(eye)];
    grids[i].feed = plan.mirrored_feed && feed.view.image ? &feed : nullptr;
    grids[i].ray_width = static_cast<float>(settings.ray_width);
    grids[i].jitter = pass && pass->jitter;
    if (grids[i].jitter) set_jitter(*pass, static_cast<int>(i), grids[i]);
    const auto tiles_along = [](int length) { return (length + kTileSide - 1) / kTileSide; };
    const bool seen = !plan.polar || grids[i].frustum_count > 0;
    const int tiles = seen ? tiles_along(grids[i].sink.width) * tiles_along(grids[i].sink.height) : 0;
    first_tile[i + 1] = first_tile[i] + tiles;
  }
}

void Renderer::Impl::run_tile(int job, int worker, RayRecorder* recorder) {
  if (!covered_tiles.empty() && covered_tiles[static_cast<std::size_t>(job)] != 0) return;
  const auto grid_index = static_cast<std::size_t>(
      std::upper_bound(first_tile.begin(), first_tile.end(), job) - first_tile.begin() - 1);
  const RayGrid& grid = grids[grid_index];
  const int tile = job - first_tile[grid_index];
  const int tiles_x = (grid.sink.width + kTileSide - 1) / kTileSide;
  const auto w = static_cast<std::size_t>(worker);
  const RayGrid* traced = &grid;
  if constexpr (kFault == Fault::samples_keyed_by_thread) {
    thread_local RayGrid of_thread;
    of_thread = grid;
    of_thread.key += static_cast<std::uint32_t>(worker);
    traced = &of_thread;
  }
  trace_tile({traced, &shading, tile % tiles_x * kTileSide, tile / tiles_x * kTileSide, tile_scratch[w].get(),
              &counters[w], &cycles[w], recorder});
}

bool Renderer::Impl::trace_tiles(StageTimes& times, const FrameUse& use) {
  const PhaseClock clock(cycles);
  const std::span<const std::uint8_t> wanted = use.pass ? use.pass->tiles : std::span<const std::uint8_t>{};
  const auto trace = [&](int job, int worker) {
    if (wanted.empty() || wanted[static_cast<std::size_t>(job)] != 0) run_tile(job, worker, nullptr);
  };
  const bool whole = threads.run(tile_count(), std::cref(trace), use.abandon);
  clock.finish(times);
  return whole;
}

void Renderer::Impl::set_up_viewports(RenderedFrame& out) {
  out.viewports.resize(profile.viewports.size());
  for (std::size_t i = 0; i < profile.viewports.size(); ++i) {
    const Viewport& viewport = profile.viewports[i];
    const auto eye = static_cast<std::size_t>(viewport.eye);
    if (out.viewports[i].width_px != viewport.width_px || out.viewports[i].height_px != viewport.height_px) {
      out.viewports[i].resize(viewport.width_px, viewport.height_px);
    }
    out.viewports[i].exposure = shown_scale();
    ViewportJob& job = viewport_jobs[i];
    job.viewport = &viewport;
    job.out = &out.viewports[i];
    job.radiance = &buffers[static_cast<std::size_t>(buffer_of(i))];
    job.polar = plan.polar;
    job.filter = settings.filter;
    job.opaque = shading.background_is_environment || shading.paints_see_through || settings.debug_tiles;
    if (plan.polar) {
      const PolarSamples& polar = *samples[eye];
      job.polar_width = polar.width();
      job.polar_height = polar.height();
      job.theta_to_column = static_cast<float>(polar.width() / polar.map().log_range);
      job.to_gaze = pixel_to_gaze(viewport, eyes[eye].gaze);
      job.exact_below_deg = exact_below_deg(viewport, polar.map(), polar.width(), polar.height());
    } else {
      job.planar_width = grids[i].sink.width;
      job.planar_height = grids[i].sink.height;
      // Each pixel has a texel of its own: no filter has anything to do.
      if (job.one_texel_per_pixel()) job.filter = ResampleFilter::nearest;
    }
    job.feed = feeds[eye].view;
  }
}

bool Renderer::Impl::composite_viewports(StageTimes& times, const std::atomic<bool>* abandon) {
  const PhaseClock clock(cycles);
  const auto composite = [this](int job, int worker) {
    const auto w = static_cast<std::size_t>(worker);
    const auto viewport = static_cast<std::size_t>(
        std::upper_bound(first_strip.begin(), first_strip.end(), job) - first_strip.begin() - 1);
    cycles[w].start();
    composite_strip(viewport_jobs[viewport], job - first_strip[viewport], *strip_scratch[w]);
    cycles[w].lap(Stage::viewports);
  };
  const bool whole = threads.run(first_strip.back(), composite, abandon);
  clock.finish(times);
  return whole;
}

void Renderer::Impl::collect_counters(RenderedFrame& out) const {
  FrameCounters& total = out.counters;
  for (const TileCounters& worker : counters) total += worker;
  for (const Viewport& v : profile.viewports) {
    total.viewport_pixels += static_cast<std::int64_t>(v.width_px) * v.height_px;
  }
  for (std::size_t eye = 0; eye < eyes.size(); ++eye) {
    out.theta_max_deg[eye] = eyes[eye].theta_max_deg;
    out.polar_width[eye] = plan.polar ? samples[eye]->width() : 0;
  }
  out.polar_height = plan.polar ? out.quality.polar_height : 0;
}

}  // namespace herr
