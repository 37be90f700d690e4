// Memory by the frame plan: buffers and scratch that its stages need, and none for those that it leaves out.
// Before: the plan, at construction and when a scene's change makes it another one. After: the frame loop,
// which allocates nothing. What a plan once needed stays.
#include <algorithm>

#include "renderer/frame/renderer_impl.h"

namespace herr {
namespace {

template <typename T>
void allocate_if(bool wanted, std::unique_ptr<T>& part) {
  if (wanted && !part) part = std::make_unique<T>();
}

template <typename T>
std::int64_t bytes_if(const std::unique_ptr<T>& part) {
  return part ? static_cast<std::int64_t>(sizeof(T)) : 0;
}

}  // namespace

void Renderer::Impl::allocate_buffers() {
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    if (plan.polar) {
      buffers[i].allocate(padded_columns(settings.polar_width), padded_rows(settings.polar_height),
                          plan.coloured_ratio);
    } else {
      const Viewport& v = profile.viewports[i];
      buffers[i].allocate(padded_columns(rays_along(v.width_px, settings.scale)),
                          padded_rows(rays_along(v.height_px, settings.scale)), plan.coloured_ratio);
    }
  }
}

void Renderer::Impl::allocate_scratch() {
  for (const std::unique_ptr<TileScratch>& scratch : tile_scratch) {
    allocate_if(plan.mirror_rays || plan.refraction, scratch->second);
    if (scratch->second) {
      allocate_if(plan.refraction, scratch->second->pending);
      allocate_if(plan.mirrored_feed, scratch->second->feed);
    }
    allocate_if(plan.further_lobes, scratch->first.lobes);
    allocate_if(plan.gloss, scratch->first.gloss);
    if (scratch->second) allocate_if(plan.gloss, scratch->second->hits.gloss);
    if (scratch->second) allocate_if(plan.further_lobes, scratch->second->hits.lobes);
    allocate_if(plan.catchers_occlude, scratch->blocked);
    allocate_if(plan.alpha_blend, scratch->layers);
    allocate_if(plan.edge_samples > 0, scratch->edges);
    // Whether light samples are adaptive may change with each frame's number of them.
    allocate_if(plan.adaptive_min_samples > 0, scratch->adaptive);
  }
}

// At construction alone, since it takes long: for probes, and for whatever surfaces events may bring.
void Renderer::Impl::filter_environment() {
  const bool shown = std::any_of(scene.instances.begin(), scene.instances.end(),
                                 [](const Instance& instance) { return !instance.catcher; });
  if (!plan.environment_map || !shown) return;
  const auto parallel = [this](int count, const std::function<void(int)>& work) {
    threads.run(count, [&](int i, int) { work(i); });
  };
  filtered_environment = std::make_unique<FilteredEnvironment>(
      scene.environment_map, settings.probes.on ? settings.probes.rays : 0, parallel);
}

MemoryUse Renderer::memory() const {
  const Impl& impl = *impl_;
  const GeometryMemory geometry = impl.geometry->memory();
  std::int64_t buffers = 0, tiles = 0, second = 0, blocked = 0, layers = 0, adaptive = 0, strips = 0,
               lobes = 0, edges = 0,
               gloss = impl.filtered_environment ? impl.filtered_environment->bytes() : 0;
  for (const RadianceBuffer& buffer : impl.buffers) buffers += buffer.bytes();
  for (const auto& samples : impl.samples) buffers += samples ? samples->bytes() : 0;
  for (const auto& places : impl.edge_places) edges += places ? places->bytes() : 0;
  for (const std::unique_ptr<TileScratch>& scratch : impl.tile_scratch) {
    tiles += static_cast<std::int64_t>(sizeof(TileScratch));
    second += bytes_if(scratch->second);
    if (scratch->second) second += bytes_if(scratch->second->pending) + bytes_if(scratch->second->feed);
    blocked += bytes_if(scratch->blocked);
    layers += bytes_if(scratch->layers);
    adaptive += bytes_if(scratch->adaptive);
    edges += bytes_if(scratch->edges);
    gloss += bytes_if(scratch->first.gloss) + (scratch->second ? bytes_if(scratch->second->hits.gloss) : 0);
    lobes += bytes_if(scratch->first.lobes) + (scratch->second ? bytes_if(scratch->second->hits.lobes) : 0);
  }
  for (const std::unique_ptr<StripScratch>& scratch : impl.strip_scratch) strips += scratch->bytes();
  std::int64_t views = 0;
  for (const BlendedView& view : impl.blended_views) views += view.bytes();
  for (const BlendScratch& scratch : impl.blend_scratch) views += scratch.bytes();
  if (impl.outside_work) views += impl.outside_work->bytes();
  return {{"acceleration structures", geometry.acceleration},
          {"surfaces", geometry.surfaces},
          {"textures", geometry.textures},
          {"voxels", geometry.voxels},
          {"probes", impl.probe_bytes()},
          {"radiance buffers", buffers},
          {"tiles in work", tiles},
          {"second rays", second},
          {"catcher shadow rays", blocked},
          {"alpha layers", layers},
          {"further lobes", lobes},
          {"gloss", gloss},
          {"adaptive light samples", adaptive},
          {"edge samples", edges},
          {"strips in work", strips},
          {"further views", views}};
}

}  // namespace herr
