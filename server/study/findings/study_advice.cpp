#include "server/study/findings/study_advice.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "server/study/findings/study_points.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr double kLeastGainAtFullScale = 8, kMostShareOfPaper = 0.7;
constexpr std::size_t kFewestForAKnee = 3;
constexpr double kSameError = 1.02;  // times an error: the same, for who compares

std::string ratio_text(const Interval& ratio) {
  std::string text = fixed_text(ratio.estimate, 2);
  if (std::isfinite(ratio.lower) && std::isfinite(ratio.upper)) {
    text += " [" + fixed_text(ratio.lower, 2) + ", " + fixed_text(ratio.upper, 2) + "]";
  }
  return text;
}

double acuity_error(const StudyPoint& point) {
  return point.error.at(Metric::acuity_rmse);
}

const StudyPoint* point_named(std::span<const StudyPoint> points, const std::string& name) {
  for (const StudyPoint& point : points) {
    if (point.name == name && point.comparable) return &point;
  }
  return nullptr;
}

// The fastest of those that `counts` and have at most this error; null: none.
template <class Counts, class Error, class Time>
const StudyPoint* fastest(std::span<const StudyPoint> points, double most_error, const Counts& counts,
                          const Error& error, const Time& time) {
  const StudyPoint* best = nullptr;
  for (const StudyPoint& point : points) {
    if (point.frames == 0 || !point.comparable || !counts(point) || !(error(point) <= most_error)) continue;
    if (best == nullptr || time(point) < time(*best)) best = &point;
  }
  return best;
}

double frame_time(const StudyPoint& point) {
  return point.time_ratio.estimate;
}

// What the picture that points are held against errs by; 0 without one.
double error_of_reference(std::span<const StudyReference> references) {
  return references.empty() ? 0 : references.front().error.at(Metric::acuity_rmse);
}

// " (as good as the default with N = 1 within the reference's error of 0.00860)": where the errors of both
// differ by no more than that, neither is known to be the better one. Empty for the default itself.
std::string doubt_of(const StudyPoint& point, const StudyPoint& of_default, double reference_error) {
  const double difference = std::abs(acuity_error(point) - acuity_error(of_default));
  const bool told_apart = !(reference_error > 0 && difference <= reference_error);
  if (point.flags == of_default.flags || told_apart) return {};
  return " (as good as the default with " + of_default.base + " within the reference's error of " +
         error_text(reference_error) + ")";
}

// "--polar 788x384; error 0.1000, time of the default times 0.50 [0.48, 0.52]", with `doubt` after the error.
std::string words_of(const StudyPoint& point, const std::string& doubt) {
  return (point.flags.empty() ? "the default" : point.flags) + "; error " + error_text(acuity_error(point)) +
         (point.at_floor ? " (at the floor of the reference)" : "") + doubt + ", time of the default times " +
         ratio_text(point.time_ratio);
}

// The fastest with at most `factor` times the error of the default, which is `words` that error.
StudyAdvice advise(std::span<const StudyPoint> points, const StudyPoint& of_default, double factor,
                   const std::string& words, double reference_error) {
  StudyAdvice advice;
  const double most_error = factor * acuity_error(of_default);
  advice.most_error = most_error;
  const auto counts = [](const StudyPoint&) { return true; };
  const StudyPoint* best = fastest(points, most_error, counts, acuity_error, frame_time);
  const std::string wish = "For an error of at most " + error_text(most_error) + " (" + words +
                           " the default with " + of_default.base + "): ";
  if (best == nullptr) {
    advice.sentence = wish + "nothing that was measured reaches it.";
    return advice;
  }
  advice.point = best->name;
  advice.sentence = wish + "take " + words_of(*best, doubt_of(*best, of_default, reference_error)) + ".";
  return advice;
}

struct LeastProduct {
  StudyAdvice advice;
  bool knee = false;  // else an end of what was measured
};

// Of the front the point with the smallest product of error and time (in logarithms where a line of slope -1
// touches it): any other one with half its error takes at least twice its time, and the other way round.
// At an end of what was measured, which need not be the end of the front, this tells nothing of what lies
// beyond.
std::optional<LeastProduct> least_product(std::span<const StudyPoint> points, double reference_error) {
  const StudyPoint *least = nullptr, *quickest = nullptr, *most_exact = nullptr;
  std::size_t count = 0;
  const auto product = [](const StudyPoint& point) { return acuity_error(point) * frame_time(point); };
  for (const StudyPoint& point : points) {
    if (!point.on_front || !(product(point) > 0)) continue;
    ++count;
    if (least == nullptr || product(point) < product(*least)) least = &point;
    if (quickest == nullptr || frame_time(point) < frame_time(*quickest)) quickest = &point;
    if (most_exact == nullptr || acuity_error(point) < acuity_error(*most_exact)) most_exact = &point;
  }
  if (count < kFewestForAKnee) return {};
  const StudyPoint* of_default = point_named(points, "default, N = 1");
  const std::string choice =
      "take " + words_of(*least, of_default ? doubt_of(*least, *of_default, reference_error) : "") + ".";
  LeastProduct found;
  found.advice.most_error = acuity_error(*least);
  found.advice.point = least->name;
  found.knee = least != quickest && least != most_exact;
  found.advice.sentence =
      found.knee ? "At the knee of the front: " + choice +
                       " Nothing that was measured has half its error in less than twice its time, or takes "
                       "half its time with less than twice its error."
                 : "For the least product of error and time, at an end of what was measured: " + choice;
  if (least == quickest) found.advice.sentence += " It is the quickest: quicker ones may pay, too.";
  if (least == most_exact) found.advice.sentence += " It has the least error: more effort may pay.";
  return found;
}

StudyAim uniform_at_same_error(std::span<const StudyPoint> points, const StudyPoint& ours) {
  StudyAim aim;
  aim.name = "rays per pixel at the error of foveation, " + ours.base + ": time against ours";
  aim.aim = 1;
  const double error = isolated_error(ours);
  // Its light samples are free, but with hard light, whose bias both share, errors are against hard light.
  const bool hard = ours.own_error.has_value();
  const auto counts = [&](const StudyPoint& point) {
    return point.knob == "uniform" && (!hard || point.base == ours.base);
  };
  const auto of_uniform = [&](const StudyPoint& point) {
    return hard ? isolated_error(point) : acuity_error(point);
  };
  const StudyPoint* same = fastest(points, kSameError * error, counts, of_uniform, frame_time);
  if (same != nullptr) {
    aim.measured = ratio_between(same->time_ratio, ours.time_ratio);
    aim.met = aim.measured.estimate >= aim.aim;
    aim.sentence = "Scale " + same->value + " with " + same->base + " has error " +
                   error_text(of_uniform(*same)) + ", " + ours.name + " has " + error_text(error) +
                   "; rays per pixel take " + ratio_text(aim.measured) + " times the frame time.";
    return aim;
  }
  const StudyPoint* best = fastest(points, HUGE_VAL, counts, of_uniform, of_uniform);
  if (best != nullptr) {
    aim.measured = ratio_between(best->time_ratio, ours.time_ratio);
    aim.met = aim.measured.estimate >= aim.aim;
    aim.sentence = "No scale reaches the error " + error_text(error) + " of " + ours.name +
                   ": the least, at scale " + best->value + ", is " + error_text(of_uniform(*best)) +
                   ", in " + ratio_text(aim.measured) + " times the frame time.";
  }
  return aim;
}

StudyAim uniform_at_full_scale(const StudyPoint& full, const StudyPoint& ours) {
  StudyAim aim;
  aim.name = "rays per pixel at full scale, " + ours.base + ": time against ours";
  aim.measured = ratio_between(full.time_ratio, ours.time_ratio);
  aim.aim = ours.base == "N = 64" ? kLeastGainAtFullScale : 1;
  aim.met = aim.measured.estimate >= aim.aim;
  aim.sentence = "Foveation is " + ratio_text(aim.measured) + " times faster; its error is " +
                 error_text(isolated_error(ours)) + ", that of rays per pixel " +
                 error_text(isolated_error(full)) + ".";
  return aim;
}

StudyAim against_paper(std::span<const StudyPoint> points, const StudyPoint& paper) {
  StudyAim aim;
  aim.name = "ours at the error of " + paper.name + ": time that is not pixels";
  aim.aim = kMostShareOfPaper;
  aim.at_least = false;
  // With hard light both have the same bias, which says nothing of either: then of the same light alone.
  const bool hard = paper.own_error.has_value();
  const auto counts = [&](const StudyPoint& point) {
    return point.knob != "uniform" && point.knob != "paper" &&
           (!hard || point.own_reference == paper.own_reference);
  };
  const auto error = [&](const StudyPoint& point) {
    return hard ? isolated_error(point) : acuity_error(point);
  };
  const auto work = [](const StudyPoint& point) { return point.work_ratio.estimate; };
  const StudyPoint* best = fastest(points, kSameError * error(paper), counts, error, work);
  if (best == nullptr) {
    aim.sentence = "Nothing that was measured has so small an error: " + error_text(error(paper)) + ".";
    return aim;
  }
  aim.measured = ratio_between(best->work_ratio, paper.work_ratio);
  aim.met = aim.measured.estimate <= aim.aim;
  aim.sentence = best->name + (best->flags.empty() ? "" : " (" + best->flags + ")") + ": error " +
                 error_text(error(*best)) + " against " + error_text(error(paper)) +
                 (hard ? ", both against hard light" : "") + "; time " + ratio_text(aim.measured) +
                 " of the paper's.";
  return aim;
}

}  // namespace

std::vector<StudyAdvice> advice_of(std::span<const StudyPoint> points,
                                   std::span<const StudyReference> references) {
  const double reference_error = error_of_reference(references);
  std::vector<StudyAdvice> all;
  const std::optional<LeastProduct> least = least_product(points, reference_error);
  if (least && least->knee) all.push_back(least->advice);
  for (const char* base : {"N = 1", "N = 64"}) {
    const StudyPoint* point = point_named(points, std::string("default, ") + base);
    if (point == nullptr) continue;
    for (const auto& [factor, words] :
         {std::pair{1.0, "that of"}, std::pair{2.0, "twice that of"}, std::pair{0.5, "half that of"},
          std::pair{0.25, "a quarter of that of"}}) {
      all.push_back(advise(points, *point, factor, words, reference_error));
    }
  }
  if (least && !least->knee) all.push_back(least->advice);
  return all;
}

std::string advice_note(double profile_scale) {
  if (profile_scale == 1) return {};
  return "Found at profile scale " + shortest_text(profile_scale) +
         ", which sees less of the fine detail; confirm at full scale.";
}

std::vector<StudyAim> aims_of(std::span<const StudyPoint> points) {
  std::vector<StudyAim> aims;
  for (const StudyPoint& point : points) {
    if (point.knob != "uniform" || point.value != "1" || point.frames == 0) continue;
    // Ours with as many light samples: the default where it is swept around them, else from the sweep of
    // those.
    const StudyPoint* ours = point_named(points, "default, " + point.base);
    if (ours == nullptr) {
      for (const StudyPoint& other : points) {
        if (other.knob == "light_samples" && "N = " + other.value == point.base) ours = &other;
      }
    }
    if (ours == nullptr) continue;
    StudyPoint against = *ours;
    against.base = point.base;
    // A light sample's own reference is no reference of pixels.
    if (ours->knob == "light_samples") against.own_error.reset();
    aims.push_back(uniform_at_full_scale(point, against));
    aims.push_back(uniform_at_same_error(points, against));
  }
  for (const StudyPoint& point : points) {
    if (point.knob == "paper" && point.frames > 0) aims.push_back(against_paper(points, point));
  }
  return aims;
}

}  // namespace herr
