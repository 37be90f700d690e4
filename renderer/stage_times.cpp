#include "renderer/stage_times.h"

namespace herr {

const char* name_of(Stage stage) {
  switch (stage) {
    case Stage::scene_update:
      return "scene_update";
    case Stage::acceleration:
      return "acceleration";
    case Stage::polar_rays:
      return "polar_rays";
    case Stage::first_hits:
      return "first_hits";
    case Stage::surfaces:
      return "surfaces";
    case Stage::light_rays:
      return "light_rays";
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
  primary_rays += other.primary_rays;
  shadow_rays += other.shadow_rays;
  catcher_shadow_rays += other.catcher_shadow_rays;
  mirror_rays += other.mirror_rays;
  mirror_shadow_rays += other.mirror_shadow_rays;
  polar_samples += other.polar_samples;
  viewport_pixels += other.viewport_pixels;
  invalid_rays += other.invalid_rays;
  nonfinite_values += other.nonfinite_values;
  commits += other.commits;
  return *this;
}

}  // namespace herr
