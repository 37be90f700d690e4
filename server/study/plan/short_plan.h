// The settings of sweeps that were asked for by name, so that a study which is too short for all of them has
// measured something of each. Before: keep_only. After: study_run measures in this order.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "server/study/plan/study_budget.h"
#include "server/study/plan/study_setting.h"

namespace herr {

// The default; the two ends of each sweep around hard light; sweeps with references of many seeds, whole,
// their ends first, since such a reference is made for all of them at once; what lies between the ends; then
// the same around soft light, whose frames take long. Within these in the order given. Of light samples the
// fewest are the only end, so that 4 and 16 come before 256.
std::vector<StudySetting> ends_first(const std::vector<StudySetting>& settings);

struct SettingCost {
  double seconds = 0;      // on one frame
  std::string reference;   // that it shares with others, made for the first of them; empty: none
  double reference_s = 0;  // what making that takes
};

// What of `settings` fits, each where its turn comes and it still fits: further frames go before settings.
// `costs`: of each. The default with hard light stays.
StudyBudget fit_in_order(const std::vector<StudySetting>& settings, const std::vector<SettingCost>& costs,
                         std::size_t frames, double seconds);

}  // namespace herr
