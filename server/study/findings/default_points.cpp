#include "server/study/findings/default_points.h"

#include <algorithm>

namespace herr {

void add_points_of_default(std::span<const StudySetting> of_default, std::vector<StudyPoint>& points) {
  for (const StudySetting& setting : of_default) {
    const auto found = std::find_if(points.begin(), points.end(), [&](const StudyPoint& point) {
      return point.knob == "default" && point.base == setting.base;
    });
    const bool is_there = std::any_of(points.begin(), points.end(),
                                      [&](const StudyPoint& point) { return point.name == setting.name; });
    // A sweep of the default alone would say nothing.
    const bool is_swept = std::any_of(points.begin(), points.end(), [&](const StudyPoint& point) {
      return point.knob == setting.knob && point.base == setting.base;
    });
    if (found == points.end() || is_there || !is_swept) continue;
    StudyPoint point = *found;
    point.name = setting.name, point.knob = setting.knob, point.value = setting.value, point.n = setting.n;
    point.of_default = true;
    point.on_front = false;
    point.flicker.reset();
    points.push_back(point);
  }
}

}  // namespace herr
