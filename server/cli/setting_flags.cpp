#include "server/cli/setting_flags.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <string>
#include <variant>

#include "renderer/settings_list.h"
#include "server/cli/flags.h"
#include "server/process/exit_code.h"
#include "server/settings/flag_values.h"

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
  return std::holds_alternative<SizeSetting>(setting.value) ? "WxH" : "NAME";
}

void read_text(const Setting& setting, const std::string& text) {
  try {
    set_text(setting, text);
  } catch (const std::invalid_argument& error) {
    throw UsageError(setting.flag + ": " + error.what());
  }
}

// The flag that does not change a switch's default, where there is one.
void add_no_probes_flag(CLI::App& app, RenderSettings& render) {
  app.add_flag_callback(
         "--no-probes", [&render] { render.probes.on = false; },
         "constant ambient light instead (the default)")
      ->group(title_of(SettingGroup::probes));
}

}  // namespace

void add_setting_flag(CLI::App& app, const Setting& setting) {
  if (is_switch(setting)) {
    const bool value = !setting.flag.starts_with("--no-");
    app.add_flag_callback(
           setting.flag, [setting, value] { set_value(setting, value); }, setting.sentence)
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

void add_quality_flag(CLI::App& app, RenderSettings& render) {
  value_flag(app, "--quality", "NAME", "shadows: hard, soft or ultra, that is 1, 64 or 256 light samples",
             [&render](const std::string& text) {
               constexpr std::array<int, 3> kSamples{1, 64, 256};
               render.light_samples = kSamples.at(parse_word("--quality", text, {"hard", "soft", "ultra"}));
             })
      ->group(title_of(SettingGroup::rays));
}

void add_render_flags(CLI::App& app, RenderSettings& render) {
  add_setting_flags(app, settings_of(render),
                    {SettingGroup::rays, SettingGroup::probes, SettingGroup::machine});
  add_quality_flag(app, render);
  add_no_probes_flag(app, render);
}

}  // namespace herr
