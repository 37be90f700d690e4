#include "server/cli/setting_flags.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <variant>

#include "renderer/settings_list.h"
#include "renderer/settings_presets.h"
#include "server/cli/flags.h"
#include "server/process/exit_code.h"
#include "server/settings/flag_values.h"
#include "sessions/text/plain_values.h"

namespace herr {
namespace {

const char* title_of(SettingGroup group) {
  switch (group) {
    case SettingGroup::session:
      return "Display and headset";
    case SettingGroup::look:
      return "Look";
    case SettingGroup::rays:
      return "Rays and light";
    case SettingGroup::probes:
      return "Light that bounces";
    case SettingGroup::time:
      return "Time and policy";
    case SettingGroup::span:
      return "Part of the session";
    case SettingGroup::files:
      return "Pictures";
    case SettingGroup::views:
      return "Further views";
    case SettingGroup::machine:
      return "Machine";
  }
  return "Options";
}

// What follows the sentence of a setting: ", 1 ... 4096 (default 1)".
std::string range_and_default(const Setting& setting) {
  const bool number = std::holds_alternative<NumberSetting>(setting.value);
  const std::string now = text_of(setting);
  return (number ? ", " + range_text(setting) : "") + " (default" +
         (now.empty() ? ": " + setting.otherwise : " " + now) + ")";
}

// How the help calls the value: N, X, a unit such as MS, or the form of a text.
std::string value_name(const Setting& setting) {
  if (const auto* number = std::get_if<NumberSetting>(&setting.value)) {
    std::string name = number->step > 0 ? "n" : setting.unit.empty() ? "x" : setting.unit;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return name;
  }
  if (const auto* text = std::get_if<TextSetting>(&setting.value)) return text->form;
  if (const auto* size = std::get_if<SizeSetting>(&setting.value)) {
    return size->follows != nullptr ? "WxH|" + size->following : "WxH";
  }
  return "NAME";
}

// "; give 800 or 802", of a whole number that is no multiple of what the setting counts by.
std::string nearest_multiples(const Setting& setting, const std::string& text) {
  const auto* number = std::get_if<NumberSetting>(&setting.value);
  if (number == nullptr || number->step < 2) return {};
  const auto lowest = static_cast<std::int64_t>(number->lowest),
             highest = static_cast<std::int64_t>(number->highest);
  try {
    const std::int64_t below = whole_number_from(text, lowest, highest) / number->step * number->step;
    std::string gives;
    for (const std::int64_t multiple : {below, below + number->step}) {
      if (multiple >= lowest && multiple <= highest)
        gives += (gives.empty() ? "; give " : " or ") + std::to_string(multiple);
    }
    return gives;
  } catch (const std::invalid_argument&) {
    return {};  // said already
  }
}

// ": it is in seconds"; empty: the setting has no unit.
std::string unit_words(const std::string& unit) {
  if (unit.empty()) return {};
  const std::string name = unit == "s"    ? "seconds"
                           : unit == "ms" ? "milliseconds"
                           : unit == "m"  ? "metres"
                                          : unit;
  return ": it is in " + name;
}

void read_text(const Setting& setting, const std::string& text) {
  try {
    set_text(setting, text);
  } catch (const std::invalid_argument& error) {
    const std::string what = error.what();
    const std::string counts = what.ends_with(kWithoutUnit) ? unit_words(setting.unit) : "";
    throw UsageError(setting.flag + ": " + what + counts + nearest_multiples(setting, text));
  }
}

// "paper: the paper's frame, foveated 1576x768; direct: direct light alone".
std::string presets_text(const std::vector<SettingsPreset>& presets, bool foveation) {
  std::string text;
  for (const SettingsPreset& preset : presets) {
    text += (text.empty() ? "" : "; ") + preset.name + ": " + preset.sentence;
    for (const auto& [name, value] : preset.sets) {
      if (foveation && name == "polar") text += ", foveated " + value;
    }
  }
  return text;
}

void add_preset_flag(CLI::App& app, const std::string& flag, const std::string& what,
                     const std::vector<SettingsPreset>& presets, RenderSettings& render, bool foveation) {
  value_flag(app, flag, "NAME",
             what + " by name, which other flags override wherever they stand: " +
                 presets_text(presets, foveation) + " (default " + presets.front().name + ")",
             [flag, &presets, &render](const std::string& text) {
               std::vector<std::string> names;
               for (const SettingsPreset& preset : presets) names.push_back(preset.name);
               apply_preset(presets.at(parse_word(flag, text, names)), render);
             })
      ->group("Settings by name");
}

}  // namespace

void add_setting_flag(CLI::App& app, const Setting& setting) {
  if (is_switch(setting)) {
    const bool value = !setting.flag.starts_with("--no-");
    const CLI::Option* there =
        app.add_flag_callback(
               setting.flag, [setting, value] { set_value(setting, value); }, setting.sentence)
            ->group(title_of(setting.group));
    if (setting.back_flag.empty()) return;
    app.add_flag_callback(
           setting.back_flag,
           [setting, value, there] {
             if (there->count() > 0)
               throw UsageError(setting.flag + ": conflicts with " + setting.back_flag +
                                "; give one of them");
             set_value(setting, !value);
           },
           "the default, after a preset")
        ->group(title_of(setting.group));
    return;
  }
  value_flag(app, setting.flag, value_name(setting), setting.sentence + range_and_default(setting),
             [setting](const std::string& text) { read_text(setting, text); })
      ->group(title_of(setting.group));
}

void add_setting_flags(CLI::App& app, const std::vector<Setting>& settings,
                       std::initializer_list<SettingGroup> groups) {
  for (const Setting& setting : settings) {
    const bool wanted = std::find(groups.begin(), groups.end(), setting.group) != groups.end();
    if (wanted && !setting.flag.empty()) add_setting_flag(app, setting);
  }
}

void add_preset_flags(CLI::App& app, RenderSettings& render, bool foveation) {
  add_preset_flag(app, "--preset", "settings", frame_presets(), render, foveation);
  add_preset_flag(app, "--quality", "shadows", shadow_presets(), render, foveation);
}

void add_render_flags(CLI::App& app, RenderSettings& render) {
  add_setting_flags(app, settings_of(render),
                    {SettingGroup::rays, SettingGroup::probes, SettingGroup::machine});
}

}  // namespace herr
