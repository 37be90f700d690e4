#include "server/settings/setting_changes.h"

#include <algorithm>

#include "renderer/settings_list.h"

namespace herr {

RenderSettings with_changes(const RenderSettings& settings, const SettingChanges& changes) {
  RenderSettings changed = settings;
  const std::vector<Setting> rows = settings_of(changed);
  for (const auto& [name, value] : changes) set_text(setting_named(rows, name), value);
  return changed;
}

std::string flags_text(const SettingChanges& changes) {
  RenderSettings any;
  const std::vector<Setting> rows = settings_of(any);
  std::string text;
  for (const auto& [name, value] : changes) {
    const Setting& row = setting_named(rows, name);
    std::string word;
    // The flag of a switch changes its default; few have one that brings it back.
    const bool back = is_switch(row) && value == text_of(row);
    const std::string& flag = back ? row.back_flag : row.flag;
    if (flag.empty()) {
      word = name + "=" + value;
    } else if (is_switch(row)) {
      word = flag;
    } else {
      word = row.flag + " " + value;
    }
    text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

SettingChanges merged(SettingChanges changes, const SettingChanges& more) {
  for (const auto& [name, value] : more) {
    const auto same = [&, &wanted = name](const auto& change) { return change.first == wanted; };
    const auto found = std::find_if(changes.begin(), changes.end(), same);
    if (found == changes.end()) {
      changes.emplace_back(name, value);
    } else {
      found->second = value;
    }
  }
  return changes;
}

SettingChanges changes_between(const RenderSettings& from, const RenderSettings& settings) {
  RenderSettings a = from, b = settings;
  const std::vector<Setting> before = settings_of(a), after = settings_of(b);
  SettingChanges changes;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const std::string value = text_of(after[i]);
    if (value != text_of(before[i])) changes.emplace_back(after[i].name, value);
  }
  return changes;
}

}  // namespace herr
