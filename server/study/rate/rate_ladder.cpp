#include "server/study/rate/rate_ladder.h"

#include <algorithm>
#include <cmath>

#include "server/quality/quality_policy.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr double kGrowth = 1.05;  // of the samples: about what two measurements of one setting differ by
constexpr double kLeastScale = 0.1;

// From `least` to `most` by equal factors.
double between(double least, double most, double share) {
  return least * std::pow(most / least, share);
}

double hundredths(double value) {
  return std::round(100 * value) / 100;
}

// 2, 3, 4, 6, 8, 12, 16, 24 ...
int more_light(int samples) {
  const bool power_of_two = (samples & (samples - 1)) == 0;
  if (samples < 3) return samples + 1;
  return power_of_two ? samples + samples / 2 : samples / 3 * 4;
}

}  // namespace

std::string polar_text(const RateSetting& setting) {
  return std::to_string(2 * setting.polar_width) + "x" + std::to_string(setting.polar_height);
}

std::string text_of(const RateSetting& setting) {
  return "polar " + polar_text(setting) + ", light samples " + std::to_string(setting.light_samples) +
         ", profile scale " + shortest_text(setting.profile_scale);
}

std::vector<RateSetting> rate_ladder(const RateSetting& most) {
  const int narrowest = default_narrowest(most.polar_width), lowest = default_lowest(most.polar_height);
  const double least_scale = std::min(most.profile_scale, std::max(kLeastScale, most.profile_scale / 10));
  const double growth = static_cast<double>(most.polar_width) / narrowest * most.polar_height / lowest;
  const int steps = std::max(1, static_cast<int>(std::ceil(std::log(growth) / std::log(kGrowth))));
  std::vector<RateSetting> ladder;
  for (int i = 0; i < steps; ++i) {
    const double share = i / static_cast<double>(steps);
    RateSetting setting;
    setting.polar_width = static_cast<int>(between(narrowest, most.polar_width, share));
    setting.polar_height =
        std::max(lowest, 2 * static_cast<int>(between(lowest, most.polar_height, share) / 2));
    setting.profile_scale = std::clamp(hundredths(between(least_scale, most.profile_scale, share)),
                                       least_scale, most.profile_scale);
    if (ladder.empty() || !(ladder.back() == setting)) ladder.push_back(setting);
  }
  RateSetting setting = most;
  setting.light_samples = 1;
  if (ladder.back() == setting) ladder.pop_back();
  for (; setting.light_samples < most.light_samples;
       setting.light_samples = more_light(setting.light_samples)) {
    ladder.push_back(setting);
  }
  ladder.push_back(most);
  return ladder;
}

}  // namespace herr
