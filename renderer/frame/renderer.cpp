#include "renderer/renderer.h"

#include <algorithm>
#include <stdexcept>

#include "renderer/frame/renderer_impl.h"
#include "renderer/probes/probe_reader.h"
#include "renderer/settings_list.h"
#include "renderer/threads/cpu_use.h"

namespace herr {
namespace {

RenderSettings resolved(RenderSettings settings, const Scene& scene) {
  check_settings(settings);
  if (settings.polar_acuity) settings.polar_width = kMostAcuityWidth, settings.polar_height = kAcuityHeight;
  if (settings.threads == 0) settings.threads = available_threads();
  settings.isa = resolve_isa(settings.isa);
  if (!settings.feed_distance_m) settings.feed_distance_m = kUsualFeedDistance_m;
  if (!settings.exposure_ev && scene.exposure) {
    settings.exposure_ev = scene.exposure->ev;
    settings.auto_exposure = settings.auto_exposure || scene.exposure->automatic;
  }
  if (!settings.exposure_ev) settings.exposure_ev = 0.0;
  return settings;
}

}  // namespace

Renderer::Impl::Impl(const Scene& scene_in, const DisplayProfile& profile_in,
                     const RenderSettings& settings_in, bool session_has_camera_in)
    : scene(scene_in),
      profile(profile_in),
      settings(resolved(settings_in, scene_in)),
      plan(plan_frame(scene_in, settings, session_has_camera_in)),
      threads(settings.threads),
      details(scene_in),
      boxes(scene_in),
      session_has_camera(session_has_camera_in),
      trace_tile(trace_tile_for(settings.isa)),
      composite_strip(composite_strip_for(settings.isa)),
      blend_strip(blend_strip_for(settings.isa)) {
  threads.inside([&] { geometry = std::make_unique<EmbreeScene>(scene, settings.isa, settings.threads); });
  measure_reach();

  for (DetailEye& eye : detail_eyes) eye.samples_per_deg = eye.most_samples_per_deg = 0;
  for (const Viewport& v : profile.viewports) {
    DetailEye& eye = detail_eyes[static_cast<std::size_t>(v.eye)];
    eye.most_samples_per_deg = std::max(eye.most_samples_per_deg, finest_pixels_per_degree(v));
  }
  for (DetailEye& eye : detail_eyes) {  // with a polar buffer that of each frame
    eye.samples_per_deg = plan.polar ? eye.most_samples_per_deg : settings.scale * eye.most_samples_per_deg;
  }
  const std::size_t viewports = profile.viewports.size();
  int widest = 1;
  for (const Viewport& v : profile.viewports) widest = std::max(widest, v.width_px);
  buffers.resize(plan.polar ? 2 : viewports);
  allocate_buffers();
  for (std::size_t i = 0; i < buffers.size() && plan.polar; ++i) {
    const int reach = settings.filter == ResampleFilter::bicubic ? 2 : 1;
    samples[i] = std::make_unique<PolarSamples>(settings.polar_width, settings.polar_height, reach);
    if (plan.edge_samples == 0) continue;
    edge_places[i] =
        std::make_unique<EdgePlaces>(settings.polar_width, settings.polar_height, plan.edge_samples);
  }
  grids.resize(buffers.size());
  first_tile.resize(buffers.size() + 1);
  find_covered_tiles();
  viewport_jobs.resize(viewports);
  first_strip.assign(1, 0);
  for (const Viewport& v : profile.viewports) {
    first_strip.push_back(first_strip.back() + (v.height_px + kStripRows - 1) / kStripRows);
  }
  lights.reserve(scene.lights.size());
  light_points.reserve(scene.lights.size());

  const auto workers = static_cast<std::size_t>(threads.count());
  for (std::size_t w = 0; w < workers; ++w) {
    tile_scratch.push_back(std::make_unique<TileScratch>());
    strip_scratch.push_back(std::make_unique<StripScratch>(widest));
  }
  allocate_scratch();
  filter_environment();
  build_further_views();
  if (plan.probes) build_probes();
  counters.resize(workers);
  cycles.resize(workers);
}

Renderer::Renderer(const Scene& scene, const DisplayProfile& profile, const RenderSettings& settings,
                   bool session_has_camera)
    : impl_(std::make_unique<Impl>(scene, profile, settings, session_has_camera)) {}

Renderer::~Renderer() = default;

const FramePlan& Renderer::plan() const {
  return impl_->plan;
}
const RenderSettings& Renderer::settings() const {
  return impl_->settings;
}
FrameQuality Renderer::full_quality() const {
  const RenderSettings& settings = impl_->settings;
  return {settings.light_samples, settings.polar_width, impl_->most_probes(), settings.polar_height};
}
RendererState Renderer::state(bool with_probes) const {
  RendererState state;
  if (with_probes && impl_->probes) state.probes = impl_->save_probes();
  state.details = impl_->details.save();
  if (impl_->geometry->placed()) state.anchor = impl_->geometry->anchor();
  return state;
}

void Renderer::restore(const RendererState& state) {
  if (!state.anchor) return;
  // Where instances come and go, the levels of the run before belong to other ones: they are chosen anew.
  if (!impl_->scene.changes) {
    impl_->details.restore(state.details,
                           [&](std::size_t i, std::uint32_t mesh) { impl_->geometry->show_mesh(i, mesh); });
  }
  const auto place = [&] { impl_->geometry->place_at(*state.anchor); };
  impl_->threads.inside(place);
  if (impl_->plan.probes != !state.probes.empty()) {
    throw std::invalid_argument(
        "the state has probes where the renderer has none, or has none where it does");
  }
  if (impl_->plan.probes) impl_->restore_probes(state.probes);
}

void Renderer::set_exposure(double ev) {
  RenderSettings changed = impl_->settings;
  changed.exposure_ev = ev;
  check_settings(changed);
  impl_->settings = changed;
}

void Renderer::restart(const SceneState& state) {
  impl_->restart(state);
}

std::optional<ProbeReader> Renderer::probes() const {
  if (!impl_->probes) return std::nullopt;
  return ProbeReader(*impl_->probes);
}

int Renderer::threads() const {
  return impl_->threads.count();
}

void Renderer::parallel_for(int count, const std::function<void(int)>& work) {
  impl_->threads.run(count, [&](int i, int) { work(i); });
}

}  // namespace herr
