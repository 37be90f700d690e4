// The sweeps that `--only` asks for by name. Before: knobs. After: study_run measures these alone.
#pragma once

#include <string>
#include <vector>

#include "server/study/plan/knobs.h"

namespace herr {

// Names that `--only` takes: StudySetting::knob of every sweep of any scene.
std::vector<std::string> sweep_names();

// `only` these knobs and the default, in the order of ends_first() (short_plan.h); empty: all, as they are.
// Throws UsageError that names the nearest for one that is none; one that the scene has nothing for stays
// left out.
void keep_only(const std::vector<std::string>& only, StudySweeps& sweeps);

}  // namespace herr
