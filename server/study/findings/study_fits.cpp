#include "server/study/findings/study_fits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>

#include "server/study/findings/study_points.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr std::size_t kPointsForAFloor = 4;
// A knob that changes the error by less is said to have no effect.
constexpr double kLeastChange = 0.02;
// Of one step that goes the other way.
constexpr double kLeastStep = 0.05;

double own_floor(const StudyPoint& point, std::span<const StudyReference> references) {
  const std::string name = point.own_error ? point.own_reference : std::string();
  for (const StudyReference& reference : references) {
    if (name.empty() || reference.name == name)
      return kFloorOfReference * reference.error.at(Metric::acuity_rmse);
  }
  return 0;
}

std::vector<const StudyPoint*> sweep_of(const Knob& knob, const std::string& base,
                                        std::span<const StudyPoint> points) {
  // Points on fewer frames than others are of other pictures.
  int frames = 1;
  for (const StudyPoint& point : points) frames = std::max(frames, point.frames);
  std::vector<const StudyPoint*> sweep;
  for (const StudyPoint& point : points) {
    if (point.knob == knob.name && point.base == base && point.frames == frames) sweep.push_back(&point);
  }
  std::stable_sort(sweep.begin(), sweep.end(),
                   [](const StudyPoint* a, const StudyPoint* b) { return a->n < b->n; });
  return sweep;
}

std::string percent(double share) {
  return fixed_text(100 * share, 0) + " %";
}

std::string direction_text(const Knob& knob, bool falls, const StudyPoint& from, const StudyPoint& to) {
  return "the error " + std::string(falls ? "falls" : "rises") + " with " + knob.effort + ", from " +
         error_text(isolated_error(from)) + " at " + from.value + " to " + error_text(isolated_error(to)) +
         " at " + to.value + ", against expectation";
}

// Of a sweep in the order of n those whose values are numbers or sizes: a word ("acuity") has no place among
// them.
std::vector<const StudyPoint*> numbers_of(const std::vector<const StudyPoint*>& sweep) {
  std::vector<const StudyPoint*> numbers;
  for (const StudyPoint* point : sweep) {
    if (point->n != 0 || (!point->value.empty() && point->value.front() == '0')) numbers.push_back(point);
  }
  return numbers;
}

// Where errors run against what is expected of the knob; empty: nowhere.
std::string direction_oddity(const Knob& knob, const std::vector<const StudyPoint*>& sweep, double floor) {
  if (sweep.size() < 2) return "";
  const bool falls = isolated_error(*sweep.back()) < isolated_error(*sweep.front());
  if (falls != (knob.expected > 0)) return direction_text(knob, falls, *sweep.front(), *sweep.back());
  for (std::size_t i = 1; i < sweep.size(); ++i) {
    const double before = isolated_error(*sweep[i - 1]), after = isolated_error(*sweep[i]);
    if (std::max(before, after) <= floor) continue;  // chance may do that
    const bool step_falls = after < before;
    if (std::abs(after - before) > kLeastStep * before && step_falls != falls) {
      return direction_text(knob, step_falls, *sweep[i - 1], *sweep[i]);
    }
  }
  return "";
}

// What is odd about a sweep in the order of n; empty: nothing.
std::string oddity(const Knob& knob, const std::vector<const StudyPoint*>& sweep,
                   std::span<const StudyReference> references) {
  if (sweep.size() < 2) return "";
  const double first = isolated_error(*sweep.front());
  const double floor = own_floor(*sweep.front(), references);
  double least = first, most = first;
  for (const StudyPoint* point : sweep) {
    least = std::min(least, isolated_error(*point));
    most = std::max(most, isolated_error(*point));
  }
  if (!(most > 0)) return "it changes nothing in these frames";
  if (most <= floor) {
    return "no value can be told from the reference, 3 times whose own error is " + error_text(floor) +
           ": what it changes is too little to see here";
  }
  if (most - least < kLeastChange * most) {
    return "the error changes by less than " + percent(kLeastChange) +
           ": other errors of the default are larger than what it changes";
  }
  if (knob.expected == 0 || knob.effort.empty()) return "";
  return direction_oddity(knob, numbers_of(sweep), floor);
}

// What cannot be told from the reference tells nothing of the power law.
StudyFit fit_of(const Knob& knob, const std::string& base, const std::vector<const StudyPoint*>& sweep,
                double reference_floor) {
  StudyFit fit;
  fit.knob = knob.name, fit.base = base, fit.effort = knob.effort, fit.theory = knob.theory;
  fit.against = sweep.front()->own_error ? "own reference" : "endless effort";
  std::vector<double> n, error;
  for (const StudyPoint* point : sweep) {
    const double value = isolated_error(*point);
    if (point->n < knob.fit_from || !(point->n > 0) || !(value > reference_floor)) continue;
    n.push_back(point->n);
    error.push_back(value);
  }
  fit.fit = fit_power(n, error, n.size() >= kPointsForAFloor);
  if (!fit.fit) fit.fit = fit_power(n, error, false);
  if (!fit.fit) fit.remark = "too few points for a fit";
  return fit;
}

}  // namespace

StudyFits fit_knobs(std::span<const Knob> knobs, std::span<const StudyPoint> points,
                    std::span<const StudyReference> references) {
  StudyFits out;
  for (const Knob& knob : knobs) {
    if (knob.name == "default" || knob.name == "paper") continue;
    std::set<std::string> bases;
    for (const StudyPoint& point : points) {
      if (point.knob == knob.name) bases.insert(point.base);
    }
    for (const std::string& base : bases) {
      const std::vector<const StudyPoint*> sweep = sweep_of(knob, base, points);
      if (sweep.empty()) continue;
      const std::string odd = oddity(knob, sweep, references);
      if (!odd.empty()) out.remarks.push_back({knob.name, (base.empty() ? "" : base + ": ") + odd});
      if (knob.effort.empty()) continue;
      out.fits.push_back(fit_of(knob, base, sweep, own_floor(*sweep.front(), references)));
      if (out.fits.back().remark.empty()) out.fits.back().remark = odd;
    }
  }
  return out;
}

}  // namespace herr
