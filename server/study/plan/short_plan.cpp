#include "server/study/plan/short_plan.h"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "server/study/plan/knobs.h"
#include "server/text/text_number.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

constexpr double kShareOfSettings = 0.95;  // the rest is for the clip and the report

enum class Place { least, most, between };

// None of a word. A size has its own; not every number is an effort (StudySetting::n).
std::optional<double> effort_of(const StudySetting& setting) {
  return setting.n != 0 ? setting.n : number_in(setting.value);
}

bool is_number(const StudySetting& setting) {
  return effort_of(setting).has_value();
}

// Least and largest effort of the sweep around one base; where all are words the first and the last.
Place place_of(const StudySetting& setting, const std::vector<StudySetting>& all) {
  const auto is_of_sweep = [&](const StudySetting& other) {
    return other.knob == setting.knob && other.base == setting.base;
  };
  const bool numbers = std::any_of(all.begin(), all.end(), [&](const StudySetting& other) {
    return is_of_sweep(other) && is_number(other);
  });
  const StudySetting *least = nullptr, *most = nullptr;
  for (const StudySetting& other : all) {
    if (!is_of_sweep(other) || is_number(other) != numbers) continue;
    if (least == nullptr || effort_of(other) < effort_of(*least)) least = &other;
    if (most == nullptr || effort_of(other) >= effort_of(*most)) most = &other;
  }
  if (least != nullptr && least->name == setting.name) return Place::least;
  // Light samples cost as much as they are many: the cheap ones come before the most.
  if (most != nullptr && most->name == setting.name && setting.knob != "light_samples") return Place::most;
  return Place::between;
}

struct Turn {
  int tier = 0;
  std::size_t sweep = 0;  // of those with references of seeds: where their sweep begins
  int rank = 0;           // within a sweep, or of what lies between: one of each in turn
  std::size_t at = 0;
  auto operator<=>(const Turn&) const = default;
};

Turn turn_of(std::size_t at, const std::vector<StudySetting>& settings,
             const std::vector<StudySetting>& all) {
  const StudySetting& setting = settings[at];
  const auto is_of_sweep = [&](const StudySetting& other) {
    return other.knob == setting.knob && other.base == setting.base;
  };
  const bool hard = setting.base == base_name(kHardSamples) || setting.base.empty();
  Turn turn{hard ? 0 : 10, 0, 0, at};
  if (setting.knob == "default") return turn;
  const Place place = place_of(setting, all);
  if (setting.own == OwnReference::seeds) {
    const auto first = std::find_if(settings.begin(), settings.end(),
                                    [&](const StudySetting& other) { return other.knob == setting.knob; });
    turn.tier += 3;
    turn.sweep = static_cast<std::size_t>(first - settings.begin());
    turn.rank = place == Place::between ? 1 : 0;
  } else if (place == Place::between) {
    turn.tier += 4;
    for (std::size_t i = 0; i < at; ++i) {
      const StudySetting& other = settings[i];
      if (is_of_sweep(other) && place_of(other, all) == Place::between) ++turn.rank;
    }
  } else {
    turn.tier += place == Place::least ? 1 : 2;
  }
  return turn;
}

}  // namespace

std::vector<StudySetting> ends_first(const std::vector<StudySetting>& settings,
                                     const std::vector<StudySetting>& of_default) {
  std::vector<StudySetting> all = settings;
  // A word that is the default is no end, wherever it stands among the words.
  std::copy_if(of_default.begin(), of_default.end(), std::back_inserter(all), is_number);
  std::vector<Turn> turns;
  for (std::size_t i = 0; i < settings.size(); ++i) turns.push_back(turn_of(i, settings, all));
  std::sort(turns.begin(), turns.end());
  std::vector<StudySetting> ordered;
  for (const Turn& turn : turns) ordered.push_back(settings[turn.at]);
  return ordered;
}

std::vector<std::string> left_out_settings(const std::vector<StudySetting>& settings,
                                           const std::function<bool(const StudySetting&)>& stays) {
  std::vector<std::string> lines;
  std::vector<std::pair<std::string, std::int64_t>> without;
  for (const StudySetting& setting : settings) {
    if (stays(setting)) continue;
    if (setting.knob == "default") {
      lines.push_back(setting.name);
      continue;
    }
    const auto same = std::find_if(without.begin(), without.end(),
                                   [&](const auto& one) { return one.first == setting.knob; });
    if (same == without.end()) {
      without.emplace_back(setting.knob, 1);
    } else {
      ++same->second;
    }
  }
  for (const auto& [knob, count] : without)
    lines.push_back(knob + ": " + counted(count, "setting", "settings"));
  return lines;
}

double seconds_of_first(const std::vector<SettingCost>& costs, std::size_t count) {
  std::set<std::string> made;
  double sum_s = 0;
  for (std::size_t i = 0; i < std::min(count, costs.size()); ++i)
    sum_s += costs[i].seconds + (made.insert(costs[i].reference).second ? costs[i].reference_s : 0);
  return sum_s;
}

StudyBudget fit_in_order(const std::vector<StudySetting>& settings, const std::vector<SettingCost>& costs,
                         std::size_t frames, double seconds) {
  StudyBudget budget;
  budget.frames = frames;
  std::set<std::string> made;
  const double needed_s = seconds_of_first(costs, costs.size());
  const double most_s = kShareOfSettings * seconds;
  while (budget.frames > 1 && needed_s * static_cast<double>(budget.frames) > most_s) --budget.frames;
  double planned_s = 0;
  std::set<std::string> planned;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const double reference_s = made.contains(costs[i].reference) ? 0 : costs[i].reference_s;
    const double more_s = (costs[i].seconds + reference_s) * static_cast<double>(budget.frames);
    const bool stays = settings[i].knob == "default" && settings[i].base == base_name(kHardSamples);
    if (!stays && planned_s + more_s > most_s) continue;
    planned_s += more_s;
    made.insert(costs[i].reference);
    planned.insert(settings[i].name);
    budget.settings.push_back(settings[i]);
  }
  budget.fits = planned_s <= most_s;
  budget.dropped.emplace_back("combinations");
  if (budget.settings.size() == settings.size() && budget.frames == frames) budget.dropped.clear();
  for (std::string& line : left_out_settings(
           settings, [&](const StudySetting& setting) { return planned.contains(setting.name); })) {
    budget.dropped.push_back(std::move(line));
  }
  if (budget.frames < frames) {
    budget.dropped.push_back(left_out_frames(budget.frames, frames));
  }
  return budget;
}

}  // namespace herr
