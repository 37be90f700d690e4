// Which flags take a stage out of a frame, or make it smaller: what to try where a rate or a target is not
// held. Before: the stage that takes most. After: `herr study --hz`, the warning of the policy deadline.
#pragma once

#include <string>

#include "renderer/stage_times.h"
#include "server/settings/setting_changes.h"

namespace herr {

// Of settings that `herr study --hz` does not choose itself: {"probes", "off"}; none where a frame has that
// stage whatever flags say.
SettingChanges changes_without(Stage stage);

// "--no-probes leaves it out"; of the viewports what makes them smaller, `profile_scale` being that of the
// setting; empty: no flag does.
std::string stage_remedy(Stage stage, double profile_scale);

// All together that leave out stages which take a twentieth of the frame or more; none where none does.
SettingChanges changes_without_long_stages(const StageTimes& mean);

}  // namespace herr
