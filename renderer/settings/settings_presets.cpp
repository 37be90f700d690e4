#include "renderer/settings_presets.h"

#include "renderer/settings_list.h"

namespace herr {

const std::vector<SettingsPreset>& frame_presets() {
  static const std::vector<SettingsPreset> presets{
      {"paper",
       "the paper's frame: hard shadows, reflections, refraction, probes and ambient occlusion",
       {{"foveation", "log-polar"},
        {"scale", "1"},
        {"filter", "bilinear"},
        {"polar", "1576x768"},
        {"light_samples", "1"},
        {"first_light_samples", "0"},
        {"occlusion_rays", "1"},
        {"occlusion_smoothing", "on"},
        {"reflections", "on"},
        {"refraction", "on"},
        {"probes", "on"}}},
      {"direct",
       "direct light alone: no probes, no ambient occlusion",
       {{"occlusion_rays", "0"}, {"probes", "off"}}},
  };
  return presets;
}

const std::vector<SettingsPreset>& shadow_presets() {
  static const std::vector<SettingsPreset> presets{
      {"hard", "1 light sample", {{"light_samples", "1"}}},
      {"soft", "64", {{"light_samples", "64"}}},
      {"ultra", "256", {{"light_samples", "256"}}},
  };
  return presets;
}

void apply_preset(const SettingsPreset& preset, RenderSettings& settings) {
  const std::vector<Setting> rows = settings_of(settings);
  for (const auto& [name, value] : preset.sets) set_text(setting_named(rows, name), value);
}

RenderSettings direct_light_settings() {
  RenderSettings settings;
  for (const SettingsPreset& preset : frame_presets()) {
    if (preset.name == "direct") apply_preset(preset, settings);
  }
  return settings;
}

}  // namespace herr
