// One setting that a study measures: the default with a few values changed. Before: knobs, combinations.
// After: measure_setting renders it; its flags stand in every report.
#pragma once

#include <string>

#include "server/settings/setting_changes.h"

namespace herr {

// Which picture a setting is held against beside the one that endless effort gives.
enum class OwnReference {
  none,
  pixels,  // rays through all pixels, light samples and all else as in the setting
  seeds,   // the mean of many seeds, this knob at its limit and all else as in the setting
};

struct StudySetting {
  std::string name;  // "polar 788x384, N = 1": unique
  std::string knob;  // a setting's name, or "default", "combination", "uniform", "paper"
  std::string base;  // what it is swept around: "N = 1"; empty where that means nothing
  std::string value;
  double n = 0;  // effort of the knob; 0: a word
  SettingChanges changes;
  OwnReference own = OwnReference::none;
  SettingChanges own_limit;  // OwnReference::seeds: on top of `changes`
  SettingChanges model;      // what the picture of endless effort has beside the default: probes, occlusion
};

}  // namespace herr
