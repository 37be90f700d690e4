// The settings of sweeps that were asked for by name, so that a study which is too short for all of them has
// measured something of each. Before: keep_only. After: study_run measures in this order.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "server/study/plan/study_budget.h"
#include "server/study/plan/study_setting.h"

namespace herr {

// The default with hard light; around hard light the end of least effort of each sweep, then that of most;
// sweeps with references of many seeds, whole, their ends first, since such a reference is made for all of
// them at once; what lies between the ends, one of each sweep in turn; then the same around soft light, whose
// frames take long, its default first. Within these in the order given. Words among numbers lie between; of
// light samples the fewest are the only end, so that 4 and 16 come before 256. `of_default`: further points
// of the sweeps, which are there already and so may be their ends (StudySweeps).
std::vector<StudySetting> ends_first(const std::vector<StudySetting>& settings,
                                     const std::vector<StudySetting>& of_default = {});

struct SettingCost {
  double seconds = 0;      // on one frame
  std::string reference;   // that it shares with others, made for the first of them; empty: none
  double reference_s = 0;  // what making that takes
};

// "polar: 3 settings": of each sweep how many do not stay, in the order of `settings`; defaults before them
// by their names.
std::vector<std::string> left_out_settings(const std::vector<StudySetting>& settings,
                                           const std::function<bool(const StudySetting&)>& stays);

// On one frame, of the first `count`.
double seconds_of_first(const std::vector<SettingCost>& costs, std::size_t count);

// What of `settings` fits, each where its turn comes and it still fits: further frames go before settings.
// `costs`: of each. The default with hard light stays.
StudyBudget fit_in_order(const std::vector<StudySetting>& settings, const std::vector<SettingCost>& costs,
                         std::size_t frames, double seconds);

}  // namespace herr
