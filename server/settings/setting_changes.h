// Values of a few settings by their names: how a frame differs from another one, and which flags ask for it.
// Before: renderer/settings_list.h. After: `herr study`, advice of which flags to give.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "renderer/render_settings.h"

namespace herr {

// Names of renderer/settings_list.h and their values as text, in the order in which they are set.
using SettingChanges = std::vector<std::pair<std::string, std::string>>;

// Throws std::invalid_argument for a name or value that is none.
RenderSettings with_changes(const RenderSettings& settings, const SettingChanges& changes);

// "--polar 788x384 --light-samples 64"; of values that no flag gives "name=value".
std::string flags_text(const SettingChanges& changes);

// `changes` and then `more`: of a setting in both the later value counts, in its first place.
SettingChanges merged(SettingChanges changes, const SettingChanges& more);

// Values of `settings` that differ from those of `from`, in the list's order.
SettingChanges changes_between(const RenderSettings& from, const RenderSettings& settings);

}  // namespace herr
