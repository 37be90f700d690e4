#include "server/study/plan/short_plan.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "server/study/plan/knobs.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

constexpr double kShareOfSettings = 0.95;  // the rest is for the clip and the report

// Least and largest effort of its sweep around one base; of words the first and the last.
bool is_an_end(const StudySetting& setting, const std::vector<StudySetting>& all) {
  const StudySetting *least = nullptr, *most = nullptr;
  for (const StudySetting& other : all) {
    if (other.knob != setting.knob || other.base != setting.base) continue;
    if (least == nullptr || other.n < least->n) least = &other;
    if (most == nullptr || other.n >= most->n) most = &other;
  }
  // Light samples cost as much as they are many: the cheap ones come before the most.
  return &setting == least || (&setting == most && setting.knob != "light_samples");
}

int turn_of(const StudySetting& setting, const std::vector<StudySetting>& all) {
  if (setting.knob == "default") return 0;
  const int soft = setting.base == base_name(kHardSamples) || setting.base.empty() ? 0 : 10;
  if (setting.own == OwnReference::seeds) return soft + 2;
  return soft + (is_an_end(setting, all) ? 1 : 3);
}

}  // namespace

std::vector<StudySetting> ends_first(const std::vector<StudySetting>& settings) {
  struct Turn {
    int turn = 0;
    std::size_t sweep = 0, at = 0;  // of those with one reference: whole sweeps, their ends first
    bool between = false;
  };
  std::vector<Turn> turns;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    Turn turn{turn_of(settings[i], settings), 0, i, false};
    if (settings[i].own == OwnReference::seeds) {
      const auto first = std::find_if(settings.begin(), settings.end(), [&](const StudySetting& other) {
        return other.knob == settings[i].knob;
      });
      turn.sweep = static_cast<std::size_t>(first - settings.begin());
      turn.between = !is_an_end(settings[i], settings);
    }
    turns.push_back(turn);
  }
  std::sort(turns.begin(), turns.end(), [](const Turn& a, const Turn& b) {
    if (a.turn != b.turn) return a.turn < b.turn;
    if (a.sweep != b.sweep) return a.sweep < b.sweep;
    return a.between != b.between ? b.between : a.at < b.at;
  });
  std::vector<StudySetting> ordered;
  for (const Turn& turn : turns) ordered.push_back(settings[turn.at]);
  return ordered;
}

StudyBudget fit_in_order(const std::vector<StudySetting>& settings, const std::vector<SettingCost>& costs,
                         std::size_t frames, double seconds) {
  StudyBudget budget;
  budget.frames = frames;
  std::set<std::string> made;
  double needed_s = 0;
  for (const SettingCost& cost : costs)
    needed_s += cost.seconds + (made.insert(cost.reference).second ? cost.reference_s : 0);
  made.clear();
  const double most_s = kShareOfSettings * seconds;
  while (budget.frames > 1 && needed_s * static_cast<double>(budget.frames) > most_s) --budget.frames;
  std::vector<std::pair<std::string, std::int64_t>> without;
  double planned_s = 0;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const double reference_s = made.contains(costs[i].reference) ? 0 : costs[i].reference_s;
    const double more_s = (costs[i].seconds + reference_s) * static_cast<double>(budget.frames);
    const bool stays = settings[i].knob == "default" && settings[i].base == base_name(kHardSamples);
    if (stays || planned_s + more_s <= most_s) {
      planned_s += more_s;
      made.insert(costs[i].reference);
      budget.settings.push_back(settings[i]);
      continue;
    }
    const auto same = std::find_if(without.begin(), without.end(),
                                   [&](const auto& one) { return one.first == settings[i].knob; });
    if (same == without.end()) {
      without.emplace_back(settings[i].knob, 1);
    } else {
      ++same->second;
    }
  }
  budget.dropped.emplace_back("combinations");
  if (budget.settings.size() == settings.size() && budget.frames == frames) budget.dropped.clear();
  for (const auto& [knob, count] : without)
    budget.dropped.push_back(knob + ": " + counted(count, "setting", "settings"));
  if (budget.frames < frames) {
    budget.dropped.push_back(std::to_string(frames - budget.frames) + " of " + std::to_string(frames) +
                             " frames");
  }
  return budget;
}

}  // namespace herr
