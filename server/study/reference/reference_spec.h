// Which picture is a reference: its settings, and what is averaged. Before: a StudySetting. After:
// reference_picture renders it.
#pragma once

#include <string>

#include "renderer/render_settings.h"
#include "server/study/plan/study_setting.h"

namespace herr {

struct ReferenceSpec {
  std::string name;         // "endless effort", "hard light", "light samples at 256, N = 1"
  RenderSettings settings;  // of each pass
  bool by_pixels = true;    // passes through many places of each pixel; else frames of many seeds
  int passes = 8;           // of each half, to begin with
  bool refined = true;      // by_pixels: goes on until it is good enough, while there is time
  // What probes know is that of the setting, noise and all, and no part of the error: the knob does not
  // change it. Else each half has probes of its own seed.
  bool same_probes = false;
  RenderSettings finest;  // a setting whose error is about the smallest that is judged by it

  bool operator==(const ReferenceSpec& other) const { return name == other.name; }
};

// What endless effort would show: rays through each pixel under a box filter, light samples jittered and all
// traced, full meshes, textures at the level of the narrower rays. `model`: what the scene is lit by
// (StudySetting::model).
ReferenceSpec endless_effort(const RenderSettings& defaults, const SettingChanges& model);

// What endless effort of the setting's knob alone would show; `defaults` with its changes are the others. For
// a setting that has one.
ReferenceSpec own_reference(const RenderSettings& defaults, const StudySetting& setting);

}  // namespace herr
