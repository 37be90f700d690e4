#include "server/study/plan/combinations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "server/study/plan/knobs.h"

namespace herr {
namespace {

struct Foretold {
  StudySetting setting;
  double log_time = 0, error = 0;
  std::size_t shared = 0;  // changes that both have: the more, the nearer is what it is foretold from
};

using ByChanges = std::map<SettingChanges, const MeasuredSetting*>;

SettingChanges sorted(SettingChanges changes) {
  std::sort(changes.begin(), changes.end());
  return changes;
}

// What both change alike, sorted; none where they want one setting at two values.
std::optional<SettingChanges> shared_changes(const SettingChanges& a, const SettingChanges& b) {
  SettingChanges shared;
  for (const auto& change : a) {
    for (const auto& other : b) {
      if (other.first != change.first) continue;
      if (other.second != change.second) return std::nullopt;
      shared.push_back(change);
    }
  }
  return sorted(std::move(shared));
}

// Without foveation there is no polar buffer to combine with.
bool is_combinable(const StudySetting& setting) {
  return setting.knob != "uniform" && setting.knob != "paper" && setting.knob != "default" &&
         !setting.changes.empty();
}

// How far below (in ln error) the best of what is at least as fast; the larger, the more is gained.
double gain(const Foretold& pair, const std::vector<std::pair<double, double>>& points) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& [log_time, error] : points) {
    if (log_time <= pair.log_time) best = std::min(best, error);
  }
  if (!std::isfinite(best)) return 1;  // faster than anything
  return std::log(best / std::max(pair.error, 1e-12));
}

StudySetting combined(const RenderSettings& defaults, const StudySetting& a, const StudySetting& b) {
  StudySetting setting;
  setting.knob = "combination";
  setting.model = a.model;
  const RenderSettings both = with_changes(defaults, merged(a.changes, b.changes));
  setting.changes = changes_between(defaults, both);
  // Hard light has a reference of its own, as in the sweeps.
  setting.own = both.light_samples == kHardSamples ? OwnReference::pixels : OwnReference::none;
  setting.value = flags_text(setting.changes);
  setting.name = setting.value;
  return setting;
}

// What was not measured, each once.
std::vector<Foretold> all_pairs(const RenderSettings& defaults,
                                const std::vector<MeasuredSetting>& measured) {
  ByChanges known;
  for (const MeasuredSetting& point : measured) known.emplace(sorted(point.setting.changes), &point);
  std::map<SettingChanges, Foretold> pairs;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    for (std::size_t k = i + 1; k < measured.size(); ++k) {
      const MeasuredSetting &a = measured[i], &b = measured[k];
      if (!is_combinable(a.setting) || !is_combinable(b.setting) || a.setting.model != b.setting.model) {
        continue;
      }
      const auto shared = shared_changes(a.setting.changes, b.setting.changes);
      if (!shared) continue;
      const auto base = known.find(*shared);
      const SettingChanges changes = sorted(merged(a.setting.changes, b.setting.changes));
      if (base == known.end() || known.count(changes) != 0) continue;
      const auto [place, is_new] = pairs.try_emplace(changes);
      Foretold& pair = place->second;
      if (!is_new && pair.shared >= shared->size()) continue;
      const double from = base->second->error;
      const double squared = a.error * a.error + b.error * b.error - from * from;
      pair.setting = combined(defaults, a.setting, b.setting);
      pair.log_time = a.log_time + b.log_time - base->second->log_time;
      pair.error = std::sqrt(std::max(squared, 0.25 * std::max(a.error * a.error, b.error * b.error)));
      pair.shared = shared->size();
    }
  }
  std::vector<Foretold> all;
  for (auto& [changes, pair] : pairs) all.push_back(std::move(pair));
  return all;
}

}  // namespace

std::vector<StudySetting> combinations(const RenderSettings& defaults,
                                       const std::vector<MeasuredSetting>& measured, std::size_t most) {
  std::vector<Foretold> pairs = all_pairs(defaults, measured);
  std::vector<std::pair<double, double>> points;
  for (const MeasuredSetting& point : measured) points.emplace_back(point.log_time, point.error);
  std::vector<StudySetting> chosen;
  while (chosen.size() < most) {
    const auto by_gain = [&](const Foretold& a, const Foretold& b) {
      return gain(a, points) < gain(b, points);
    };
    const auto best = std::max_element(pairs.begin(), pairs.end(), by_gain);
    if (best == pairs.end() || !(gain(*best, points) > 0)) break;
    points.emplace_back(best->log_time, best->error);
    chosen.push_back(std::move(best->setting));
    pairs.erase(best);
  }
  return chosen;
}

}  // namespace herr
