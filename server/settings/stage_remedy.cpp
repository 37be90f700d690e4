#include "server/settings/stage_remedy.h"

#include <cstddef>
#include <utility>

namespace herr {
namespace {

constexpr double kWorthLeavingOut = 0.05;   // of the frame
constexpr double kLeastProfileScale = 0.1;  // that a frame may have

}  // namespace

SettingChanges changes_without(Stage stage) {
  switch (stage) {
    case Stage::probe_rays:
    case Stage::probe_update:
    case Stage::indirect_light:
      return {{"probes", "off"}};
    case Stage::occlusion:
      return {{"occlusion_rays", "0"}};
    case Stage::second_hits:
    case Stage::second_light:
      return {{"reflections", "off"}, {"refraction", "off"}};
    case Stage::edges:
      return {{"edge_samples", "0"}};
    case Stage::scene_update:
    case Stage::acceleration:
    case Stage::polar_rays:
    case Stage::first_hits:
    case Stage::surfaces:
    case Stage::light_rays:
    case Stage::resolve:
    case Stage::viewports:
    case Stage::overlays:
    case Stage::idle:
    case Stage::other:
      return {};
  }
  return {};
}

std::string stage_remedy(Stage stage, double profile_scale) {
  if (stage == Stage::viewports) {
    return profile_scale > kLeastProfileScale ? "a smaller --profile-scale makes it shorter"
                                              : "a --profile of fewer pixels makes it shorter";
  }
  const SettingChanges changes = changes_without(stage);
  if (changes.empty()) return {};
  return flags_text(changes) + (changes.size() > 1 ? " leave it out" : " leaves it out");
}

SettingChanges changes_without_long_stages(const StageTimes& mean) {
  SettingChanges all;
  for (std::size_t i = 0; i < kStageCount; ++i) {
    if (mean.ms[i] < kWorthLeavingOut * mean.frame_ms) continue;
    all = merged(std::move(all), changes_without(static_cast<Stage>(i)));
  }
  return all;
}

}  // namespace herr
