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
    case Stage::edges:
      return "edges";
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

}  // namespace herr
