#include "server/study/plan/only_sweeps.h"

#include <algorithm>

#include "renderer/settings_list.h"
#include "server/process/exit_code.h"
#include "server/study/plan/short_plan.h"
#include "sessions/files/input_error.h"
#include "sessions/files/nearest_name.h"

namespace herr {

std::vector<std::string> sweep_names() {
  std::vector<std::string> names;
  RenderSettings any;
  for (const Setting& setting : settings_of(any)) {
    // Rays per pixel are swept as `uniform`.
    const bool uniform = setting.name == "foveation" || setting.name == "scale";
    if (setting.effect == SettingEffect::error_for_time && !uniform) names.push_back(setting.name);
  }
  names.insert(names.end(), {"polar_width", "polar_height", "uniform", "paper", "adaptive_samples"});
  return names;
}

void keep_only(const std::vector<std::string>& only, StudySweeps& sweeps) {
  if (only.empty()) return;
  const std::vector<std::string> known = sweep_names();
  for (const std::string& name : only) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw UsageError("--only: '" + printable(name) + "' is no sweep; " + key_remedy(name, known));
  }
  const auto is_other = [&](const std::string& name) {
    return name != "default" && std::find(only.begin(), only.end(), name) == only.end();
  };
  for (std::vector<StudySetting>* settings : {&sweeps.settings, &sweeps.of_default}) {
    std::erase_if(*settings, [&](const StudySetting& setting) { return is_other(setting.knob); });
  }
  std::erase_if(sweeps.knobs, [&](const Knob& knob) { return is_other(knob.name); });
  sweeps.settings = ends_first(sweeps.settings, sweeps.of_default);
}

}  // namespace herr
