// Settings that go together by a name: frames (--preset) and shadows (--quality). Before: settings_list.h
// names each setting. After: the command line applies one before any other flag; tests take theirs from it.
// Source of the paper's frame: sections 2.4, 3.1 to 3.3 and 4.1.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "renderer/render_settings.h"

namespace herr {

struct SettingsPreset {
  std::string name;
  std::string sentence;
  // Names and values of settings_list.h; the others stay as they are.
  std::vector<std::pair<std::string, std::string>> sets;
};

// "paper", which is what RenderSettings{} has, and "direct".
const std::vector<SettingsPreset>& frame_presets();
// "hard", "soft", "ultra": light samples.
const std::vector<SettingsPreset>& shadow_presets();

void apply_preset(const SettingsPreset& preset, RenderSettings& settings);

// The default under the preset "direct".
RenderSettings direct_light_settings();

}  // namespace herr
