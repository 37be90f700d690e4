#include "renderer/stage_times.h"

namespace herr {

const char* name_of(Stage stage) {
  switch (stage) {
    case Stage::scene_update:
      return "scene_update";
    case Stage::acceleration:
      return "acceleration";
    case Stage::probe_rays:
      return "probe_rays";
    case Stage::probe_update:
      return "probe_update";
    case Stage::polar_rays:
      return "polar_rays";
    case Stage::first_hits:
      return "first_hits";
    case Stage::surfaces:
      return "surfaces";
    case Stage::light_rays:
      return "light_rays";
    case Stage::occlusion:
      return "occlusion";
    case Stage::indirect_light:
      return "indirect_light";
    case Stage::second_hits:
      return "second_hits";
    case Stage::second_light:
      return "second_light";
    case Stage::resolve:
      return "resolve";
    case Stage::viewports:
      return "viewports";
    case Stage::overlays:
      return "overlays";
    case Stage::idle:
      return "idle";
    case Stage::other:
      return "other";
  }
  return "unknown";
}

FrameCounters& FrameCounters::operator+=(const FrameCounters& other) {
  rays += other.rays;
  polar_samples += other.polar_samples;
  viewport_pixels += other.viewport_pixels;
  invalid_rays += other.invalid_rays;
  nonfinite_values += other.nonfinite_values;
  commits += other.commits;
  instances_moved += other.instances_moved;
  instances_spawned += other.instances_spawned;
  instances_removed += other.instances_removed;
  instances_restyled += other.instances_restyled;
  meshes_refitted += other.meshes_refitted;
  meshes_rebuilt += other.meshes_rebuilt;
  plan_changes += other.plan_changes;
  return *this;
}

}  // namespace herr
