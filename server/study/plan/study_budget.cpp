#include "server/study/plan/study_budget.h"

#include <algorithm>
#include <cmath>

#include "server/study/plan/knobs.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

// Of the time; the rest is for the clip and the report.
constexpr double kShareOfKnobs = 0.95;
constexpr double kLeastShareOfCombinations = 0.1;

double sum_of(const std::vector<double>& seconds) {
  double sum = 0;
  for (const double value : seconds) sum += value;
  return sum;
}

bool is_kept(const std::string& knob) {
  return knob == "default" || knob == "light_samples" || knob == "polar";
}

}  // namespace

std::string left_out_frames(std::size_t kept, std::size_t all) {
  return std::to_string(all - kept) + " of " + std::to_string(all) + " frames";
}

StudyBudget fit_to_time(const std::vector<StudySetting>& settings, const std::vector<double>& seconds_of,
                        std::size_t frames, double seconds) {
  StudyBudget budget;
  budget.settings = settings;
  budget.frames = frames;
  std::vector<double> costs = seconds_of;
  const auto needed = [&] { return sum_of(costs) * static_cast<double>(budget.frames); };
  if (needed() > seconds * (kShareOfKnobs - kLeastShareOfCombinations))
    budget.dropped.emplace_back("combinations");
  // Around soft light first: its frames take long.
  for (const bool soft : {true, false}) {
    const auto may_go = [&](const StudySetting& setting) {
      const bool swept = setting.knob != "uniform" && setting.knob != "paper";
      return !is_kept(setting.knob) && (!soft || (swept && setting.base == base_name(kSoftSamples)));
    };
    while (needed() > seconds * kShareOfKnobs) {
      const auto last = std::find_if(budget.settings.rbegin(), budget.settings.rend(), may_go);
      if (last == budget.settings.rend()) break;
      const std::string knob = last->knob;
      std::size_t count = 0;
      for (std::size_t i = budget.settings.size(); i-- > 0;) {
        if (budget.settings[i].knob != knob || !may_go(budget.settings[i])) continue;
        budget.settings.erase(budget.settings.begin() + static_cast<std::ptrdiff_t>(i));
        costs.erase(costs.begin() + static_cast<std::ptrdiff_t>(i));
        ++count;
      }
      budget.dropped.push_back(knob + (soft ? ", " + base_name(kSoftSamples) : std::string()) + ": " +
                               counted(static_cast<std::int64_t>(count), "setting", "settings"));
    }
  }
  while (needed() > seconds * kShareOfKnobs && budget.frames > 1) --budget.frames;
  if (budget.frames < frames) {
    budget.dropped.push_back(left_out_frames(budget.frames, frames));
  }
  budget.fits = needed() <= seconds * kShareOfKnobs;
  return budget;
}

}  // namespace herr
