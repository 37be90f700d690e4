// The settings of a render as a list: what can be chosen, within which range, and what it does.
// Before: a flag, a document or a study sets one by name. After: the renderer checks them all.
#pragma once

#include <vector>

#include "renderer/render_settings.h"
#include "renderer/setting.h"

namespace herr {

inline constexpr int kMostAdaptiveSamples = 256;  // light samples of a hit that are traced a few first

// One row for each field, save `force`, which no user sets. The rows refer to `settings`, which must
// outlive them and stay where it is.
std::vector<Setting> settings_of(RenderSettings& settings);

// Throws std::invalid_argument for the first one that is out of range.
void check_settings(const RenderSettings& settings);

}  // namespace herr
