#include "server/study/plan/combinations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "server/study/plan/knobs.h"

namespace herr {
namespace {

struct Foretold {
  StudySetting setting;
  double log_time = 0, error = 0;
};

bool disjoint(const SettingChanges& a, const SettingChanges& b) {
  return std::none_of(a.begin(), a.end(), [&](const auto& change) {
    return std::any_of(b.begin(), b.end(), [&](const auto& other) { return other.first == change.first; });
  });
}

bool same_changes(SettingChanges a, SettingChanges b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
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

std::vector<Foretold> all_pairs(const RenderSettings& defaults,
                                const std::vector<MeasuredSetting>& measured) {
  std::vector<Foretold> pairs;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    for (std::size_t k = i + 1; k < measured.size(); ++k) {
      const MeasuredSetting &a = measured[i], &b = measured[k];
      if (!is_combinable(a.setting) || !is_combinable(b.setting) || a.setting.model != b.setting.model ||
          !disjoint(a.setting.changes, b.setting.changes)) {
        continue;
      }
      Foretold pair;
      pair.log_time = a.log_time + b.log_time - b.base_log_time;
      const double squared = a.error * a.error + b.error * b.error - b.base_error * b.base_error;
      pair.error = std::sqrt(std::max(squared, 0.25 * a.error * a.error));
      pair.setting.knob = "combination";
      pair.setting.model = a.setting.model;
      pair.setting.changes =
          changes_between(defaults, with_changes(defaults, merged(a.setting.changes, b.setting.changes)));
      // Hard light has a reference of its own, as in the sweeps.
      const bool hard = with_changes(defaults, pair.setting.changes).light_samples == kHardSamples;
      pair.setting.own = hard ? OwnReference::pixels : OwnReference::none;
      pair.setting.value = flags_text(pair.setting.changes);
      pair.setting.name = pair.setting.value;
      pairs.push_back(std::move(pair));
    }
  }
  return pairs;
}

}  // namespace

std::vector<StudySetting> combinations(const RenderSettings& defaults,
                                       const std::vector<MeasuredSetting>& measured, std::size_t most) {
  std::vector<Foretold> pairs = all_pairs(defaults, measured);
  std::vector<std::pair<double, double>> points;
  std::set<std::string> taken;
  for (const MeasuredSetting& point : measured) points.emplace_back(point.log_time, point.error);
  std::vector<StudySetting> chosen;
  while (chosen.size() < most) {
    const Foretold* best = nullptr;
    double most_gain = 0;
    for (const Foretold& pair : pairs) {
      if (taken.count(pair.setting.name) != 0) continue;
      const bool known = std::any_of(measured.begin(), measured.end(), [&](const MeasuredSetting& m) {
        return same_changes(m.setting.changes, pair.setting.changes);
      });
      const double gained = known ? 0 : gain(pair, points);
      if (gained > most_gain) most_gain = gained, best = &pair;
    }
    if (best == nullptr) break;
    taken.insert(best->setting.name);
    points.emplace_back(best->log_time, best->error);
    chosen.push_back(best->setting);
  }
  return chosen;
}

}  // namespace herr
