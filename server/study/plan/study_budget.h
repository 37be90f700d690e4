// What the time of a study is enough for. Combinations go first, then sweeps around soft light from the end
// of the list, then whole sweeps, then frames. Before: how long a setting takes. After: study_run measures
// what is left and lists what is not.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "server/study/plan/study_setting.h"

namespace herr {

struct StudyBudget {
  std::size_t frames = 1;  // of those chosen, from the first
  std::vector<StudySetting> settings;
  std::vector<std::string> dropped;  // "combinations", "detail_error, N = 64: 3 settings", "1 of 3 frames"
  bool fits = true;                  // what stays is expected to take no more than the time
};

// "1 of 3 frames": of `all` those that are left out.
std::string left_out_frames(std::size_t kept, std::size_t all);

// `seconds_of`: of one frame, for each of `settings`. Default, light samples and polar size
// stay in the plan, for as long as there is time to measure them.
StudyBudget fit_to_time(const std::vector<StudySetting>& settings, const std::vector<double>& seconds_of,
                        std::size_t frames, double seconds);

}  // namespace herr
