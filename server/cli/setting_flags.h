// Flags made from lists of settings: name, help, range and default stand in the list's row. Before: the lists
// (renderer/settings_list.h, server/settings/run_settings.h). After: the structs that hold the values.
#pragma once

#include <initializer_list>
#include <vector>

#include "renderer/render_settings.h"
#include "renderer/setting.h"

namespace CLI {
class App;
}

namespace herr {

// The default that the help states is the present value. What the setting refers to must outlive `app`. When
// the line is read, a value that the setting does not take is a UsageError that names the flag.
void add_setting_flag(CLI::App& app, const Setting& setting);
// Those of some groups that have a flag.
void add_setting_flags(CLI::App& app, const std::vector<Setting>& settings,
                       std::initializer_list<SettingGroup> groups);

// --preset and --quality: settings by name. Flags take effect in the order in which they are added, wherever
// they stand on the line: a command adds this one before any flag that may override it.
// `foveation`: the command can foveate a frame.
void add_preset_flags(CLI::App& app, RenderSettings& render, bool foveation = true);
// What every command that renders shares: rays, probes and the machine.
void add_render_flags(CLI::App& app, RenderSettings& render);

}  // namespace herr
