#include "server/study/findings/study_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>

#include "renderer/timing.h"
#include "server/study/findings/study_timing.h"
#include "server/study/statistics/paired_ratio.h"
#include "server/study/statistics/pareto_front.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

struct Gathered {
  std::vector<ErrorTable> errors, own_errors;
  std::vector<double> log_ratios, work_log_ratios, frame_ms, pixels_ms, calibration_ms, biases;
  FrameCounters counters;
  int frames = 0;
  std::string reference;
};

template <class Value>
void append(std::vector<Value>& to, const std::vector<Value>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

StudyPoint described(const StudyRow& row) {
  StudyPoint point;
  point.name = row.name, point.knob = row.knob, point.base = row.base, point.value = row.value;
  point.n = row.n, point.flags = row.flags, point.own_reference = row.own_reference;
  return point;
}

// The default takes as long as itself: what its pairs differ by is the machine's doing (study_timing.h).
std::vector<double> ratios_of(const StudyRow& row, const std::vector<double>& measured) {
  return is_the_default(row) ? std::vector<double>(measured.size(), 0.0) : measured;
}

void add(const StudyRow& row, Gathered& to) {
  if (row.error) to.errors.push_back(*row.error);
  if (row.own_error) to.own_errors.push_back(*row.own_error);
  append(to.log_ratios, ratios_of(row, row.log_ratios));
  append(to.work_log_ratios, ratios_of(row, row.work_log_ratios));
  to.frame_ms.push_back(row.frame_ms);
  to.pixels_ms.push_back(row.pixels_ms);
  to.calibration_ms.push_back(row.calibration_ms);
  if (row.bias) to.biases.push_back(*row.bias * *row.bias);
  to.counters += row.counters;
  to.reference = row.reference;
  ++to.frames;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

const StudyReference* named(std::span<const StudyReference> references, const std::string& name) {
  for (const StudyReference& reference : references) {
    if (reference.name == name) return &reference;
  }
  return nullptr;
}

void finish(const Gathered& from, std::span<const StudyReference> references, std::size_t frames,
            StudyPoint& point) {
  if (from.frames == 0) return;
  point.frames = from.frames;
  point.error = over_frames(from.errors);
  if (!from.own_errors.empty()) point.own_error = over_frames(from.own_errors);
  // Another model of light has other errors; fewer frames are other frames.
  point.comparable =
      !references.empty() && from.reference == references.front().name && from.errors.size() == frames;
  const bool exact = point.flags.empty();
  point.time_ratio = exact ? Interval{1, 1, 1} : paired_ratio(from.log_ratios);
  point.work_ratio = exact ? Interval{1, 1, 1} : paired_ratio(from.work_log_ratios);
  point.frame_ms = median(from.frame_ms);
  point.pixels_ms = median(from.pixels_ms);
  point.calibration_ms = median(from.calibration_ms);
  if (!from.biases.empty()) point.bias = std::sqrt(mean(from.biases));
  for_each_counter(from.counters, [&](const std::string& name, const std::int64_t& count) {
    if (count != 0) point.counters.emplace_back(name, static_cast<double>(count) / from.frames);
  });
  if (const StudyReference* reference = named(references, from.reference)) {
    point.at_floor =
        point.error.at(Metric::acuity_rmse) < kFloorOfReference * reference->error.at(Metric::acuity_rmse);
  }
}

void find_front(const std::vector<Gathered>& gathered, std::vector<StudyPoint>& points) {
  std::vector<FrontCandidate> candidates(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].comparable) continue;
    for (const ErrorTable& error : gathered[i].errors) {
      candidates[i].frame_errors.push_back(std::max(error.at(Metric::acuity_rmse), 1e-12));
    }
    candidates[i].log_ratios = gathered[i].log_ratios;
  }
  const std::vector<FrontPlace> places = pareto_front(candidates);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].on_front = places[i].on_front;
    points[i].front_confidence = places[i].confidence;
  }
}

}  // namespace

std::vector<StudyPoint> points_of(std::span<const StudyRow> rows,
                                  std::span<const StudyReference> references) {
  std::vector<StudyPoint> points;
  std::vector<Gathered> gathered;
  std::map<std::string, std::size_t> index;
  for (const StudyRow& row : rows) {
    const auto [place, is_new] = index.try_emplace(row.name, points.size());
    if (is_new) {
      points.push_back(described(row));
      gathered.emplace_back();
    }
    if (row.flicker) {
      points[place->second].flicker = row.flicker;
    } else {
      add(row, gathered[place->second]);
    }
  }
  std::size_t frames = 0;
  for (const Gathered& of_point : gathered) frames = std::max(frames, of_point.errors.size());
  for (std::size_t i = 0; i < points.size(); ++i) finish(gathered[i], references, frames, points[i]);
  find_front(gathered, points);
  return points;
}

Interval ratio_between(const Interval& first, const Interval& second) {
  for (const Interval* of : {&first, &second}) {
    if (std::isfinite(of->lower) && std::isfinite(of->upper)) continue;
    Interval unbounded;
    unbounded.estimate = first.estimate / second.estimate;
    return unbounded;
  }
  const auto wider = [](double a, double b) { return std::sqrt(a * a + b * b); };
  const double middle = std::log(first.estimate / second.estimate);
  const double down = wider(std::log(first.estimate / first.lower), std::log(second.upper / second.estimate));
  const double up = wider(std::log(first.upper / first.estimate), std::log(second.estimate / second.lower));
  return {std::exp(middle), std::exp(middle - down), std::exp(middle + up)};
}

std::string error_text(double value) {
  return fixed_text(value, value < 0.01 ? 5 : 4);
}

double isolated_error(const StudyPoint& point) {
  return (point.own_error ? *point.own_error : point.error).at(Metric::acuity_rmse);
}

}  // namespace herr
