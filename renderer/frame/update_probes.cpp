// Stage: probes. Rays of this frame's probes against last frame's light, blended into what they have
// gathered, then published for all that follows in this frame. Also how a renderer sets its probes up.
#include <algorithm>
#include <iterator>

#include "renderer/direct_light/light_records.h"
#include "renderer/environment/sky_of_rays.h"
#include "renderer/frame/renderer_impl.h"
#include "renderer/memory_use.h"
#include "renderer/probes/probe_placement.h"
#include "renderer/tiles/finite_lanes.h"
#include "renderer/timing.h"

namespace herr {
namespace {

constexpr int kProbeKey = 2;  // beside the eyes 0 and 1: random numbers of the frame

double summed_power(const SceneState& state) {
  double sum = 0;
  for (const AreaLight& light : state.lights) {
    sum += double{light.intensity_w_sr.x} + double{light.intensity_w_sr.y} + double{light.intensity_w_sr.z};
  }
  return sum;
}

// Debug builds: what probes have gathered is finite.
void require_finite_probes(const ProbeVolume& probes) {
  if constexpr (!kStagesAreChecked) return;
  for (const ProbeSet& set : probes.sets) {
    require_none(Stage::probe_update, first_not_finite(std::span(set.gathered), "gathered"));
    require_none(Stage::probe_update, first_not_finite(std::span(set.mean), "mean"));
    require_none(Stage::probe_update, first_not_finite(std::span(set.square), "square"));
  }
}

}  // namespace

void Renderer::Impl::build_probes() {
  const ProbeGrid grid = probe_grid_of(scene, settings.probes.density);
  probes = std::make_unique<ProbeVolume>(grid, settings.probes, plan.catcher_probes ? 2 : 1);
  if (plan.catcher_probes) probes->sets[1].mask = kCatcherMask;
  probe_kernels = probe_kernels_for(settings.isa);
  plan_probes();
  probe_lights.reserve(scene.lights.size());
  real_probe_lights.reserve(scene.lights.size());
  probe_radiance.resize(static_cast<std::size_t>(threads.count()));
  for (auto& radiance : probe_radiance)
    radiance.resize(kProbeRayLanes * static_cast<std::size_t>(settings.probes.rays));
  place_for_probes();
  ProbePlacement::settle(*probes, scene, *geometry, threads);
  if (scene.changes) {
    probe_motion = std::make_unique<ProbeMotion>(scene, *geometry, boxes, probes->grid, threads.count());
  }
}

// Around the middle of their grid, where they look around before there is a head.
void Renderer::Impl::place_for_probes() {
  const ProbeGrid& grid = probes->grid;
  geometry->follow(grid.lower + 0.5 * glm::dvec3(grid.counts) * grid.spacing);
  SceneUpdate nobodys;
  const auto place = [&] { geometry->commit_changes(nobodys); };
  threads.inside(std::cref(place));
}

void Renderer::Impl::plan_probes() {
  probe_plan = plan;
  probe_plan.catchers = probe_plan.catchers_occlude = probe_plan.catcher_mirrors = false;
  probe_plan.occlusion = false;
}

void Renderer::Impl::aim_probes(const FrameSample& sample, const SceneState& state, int most) {
  probes->begin_frame(sample.t_ns, summed_power(state), most);
  probes->directions.aim(frame_key(sample.t_ns - sample.start_ns, kProbeKey, settings.seed),
                         probes->node_directions);
  if (filtered_environment) {
    aim_sky(probes->directions, probes->node_directions, *filtered_environment, shading.environment_map.turn);
  }
  real_probe_lights.clear();
  light_records(state.lights, geometry->anchor(), probe_plan.light_sampling(1), light_reach(), probe_lights);
  // Catchers alone stand for the real room, in which no virtual light shines.
  std::copy_if(probe_lights.begin(), probe_lights.end(), std::back_inserter(real_probe_lights),
               [](const LightRecord& light) { return !light.is_virtual; });
  view_probes();
  for (std::size_t set = 0; set < probes->sets.size(); ++set) {
    ShadingInputs& by_probes = probe_shading[set] = shading;
    by_probes.plan = &probe_plan;
    by_probes.lights = set == 0 ? probe_lights : real_probe_lights;
    by_probes.probes = &probe_views[set];
    by_probes.catcher_probes = nullptr;
  }
}

// As they are, from where the anchor is now.
void Renderer::Impl::view_probes() {
  for (std::size_t set = 0; set < probes->sets.size(); ++set) {
    probe_views[set] = probes->view(static_cast<int>(set), geometry->anchor());
  }
  shading.probes = &probe_views[0];
  shading.catcher_probes = plan.catcher_probes ? &probe_views[1] : nullptr;
}

ProbeJob Renderer::Impl::probe_job(int job, int worker, RayRecorder* recorder) {
  const auto w = static_cast<std::size_t>(worker);
  const int set = job / probes->job_count();
  ProbeJob out;
  out.tile.shading = &probe_shading[static_cast<std::size_t>(set)];
  out.tile.scratch = tile_scratch[w].get();
  out.tile.counters = &counters[w];
  out.tile.cycles = &cycles[w];
  out.tile.recorder = recorder;
  out.volume = probes.get();
  out.set = set;
  out.job = job % probes->job_count();
  out.radiance = probe_radiance[w].data();
  return out;
}

void Renderer::Impl::publish_probes() {
  threads.run(probe_job_count(), [this](int index, int worker) {
    const ProbeJob job = probe_job(index, worker, nullptr);
    job.tile.cycles->start();
    probe_kernels.publish(job);
    job.tile.cycles->lap(Stage::probe_update);
  });
}

std::vector<std::byte> Renderer::Impl::save_probes() const {
  std::vector<std::byte> bytes = probes->save();
  if (probe_motion) probe_motion->save(*probes, bytes);
  return bytes;
}

void Renderer::Impl::restore_probes(std::span<const std::byte> bytes) {
  if (probe_motion) probe_motion->restore(*probes, bytes);
  probes->restore(bytes);
  publish_probes();
}

void Renderer::Impl::update_probes(const FrameSample& sample, const SceneState& state, RenderedFrame& out) {
  if (probe_motion) {
    out.times[Stage::probe_rays] +=
        wall_ms([&] { probe_motion->follow(*probes, *geometry, threads, sample.t_ns, out.quality.probes); });
  }
  const PhaseClock serial(cycles);
  cycles[0].start();
  aim_probes(sample, state, out.quality.probes);
  cycles[0].lap(Stage::probe_update);
  serial.finish(out.times);

  const PhaseClock gathering(cycles);
  threads.run(probe_job_count(), [this](int index, int worker) {
    const ProbeJob job = probe_job(index, worker, nullptr);
    job.tile.cycles->start();
    probe_kernels.trace(job);
    job.tile.cycles->lap(Stage::probe_rays);
    probe_kernels.blend(job);
    job.tile.cycles->lap(Stage::probe_update);
  });
  gathering.finish(out.times);
  require_finite_probes(*probes);

  const PhaseClock publishing(cycles);
  publish_probes();
  publishing.finish(out.times);
  probes->end_frame();
  out.probes = probes->counts();
}

std::int64_t Renderer::Impl::probe_bytes() const {
  if (!probes) return 0;
  std::int64_t sum = probes->bytes() + bytes_of(probe_lights) + bytes_of(real_probe_lights);
  if (probe_motion) sum += probe_motion->bytes();
  for (const auto& radiance : probe_radiance) sum += bytes_of(radiance);
  return sum;
}

}  // namespace herr
