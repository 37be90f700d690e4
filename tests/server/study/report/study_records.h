// Records of studies for tests: one with everything, one with next to nothing, one full of values that break
// what is careless.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "server/study/report/study_record.h"

namespace herr::test {

// Made up: errors of all metrics and bands in proportion to one.
inline ErrorTable error_table(double acuity_rmse) {
  constexpr double kOfAcuity[kMetrics] = {1.7, 3.1, 12, 40, 0, 1, 4};
  ErrorTable table;
  for (std::size_t band = 0; band < kBands; ++band) {
    const double scale = acuity_rmse * (band == kAllPixels ? 1 : 0.5 + 0.3 * double(band));
    for (std::size_t metric = 0; metric < kMetrics; ++metric) {
      table.value[band][metric] = kOfAcuity[metric] * scale;
    }
    table.value[band][static_cast<std::size_t>(Metric::psnr_db)] = -20 * std::log10(1.7 * scale);
  }
  return table;
}

inline Interval around(double estimate, double share) {
  return {estimate, estimate * (1 - share), estimate * (1 + share)};
}

inline StudyPoint study_point(const std::string& knob, const std::string& base, const std::string& value,
                              double n, double error, double ratio) {
  StudyPoint point;
  point.name = knob + " " + value + (base.empty() ? "" : ", " + base);
  point.knob = knob;
  point.base = base;
  point.value = value;
  point.n = n;
  point.flags = "--" + knob + " " + value;
  point.frames = 8;
  point.comparable = true;
  point.error = error_table(error);
  point.time_ratio = around(ratio, 0.03);
  point.frame_ms = 21.3 * ratio;
  point.pixels_ms = 4.2;
  point.calibration_ms = 7.1;
  point.counters = {{"primary_rays", 302592}, {"shadow_rays", 123456.5 * ratio}, {"occlusion_rays", 0.1}};
  return point;
}

inline StudyPicture small_picture(const std::string& title) {
  StudyPicture picture;
  picture.title = title;
  picture.caption = "Left: picture. Middle: reference. Right: difference times 16.";
  picture.width_px = 3;
  picture.height_px = 2;
  picture.png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 255, 7};
  return picture;
}

inline void add_sweeps(StudyRecord& record) {
  constexpr const char* kKnobs[] = {"light-samples", "polar",           "occlusion-rays", "fine-samples",
                                    "mirror-rays",   "history",         "probe-rays",     "probe-spacing",
                                    "detail",        "penumbra-samples"};
  std::mt19937 engine(1);
  const auto jitter = [&] { return 1 + 0.2 * (double(engine() % 1000) / 1000 - 0.5); };
  int number = 0;
  for (const char* knob : kKnobs) {
    ++number;
    for (const char* base : {"N = 1", "N = 64"}) {
      for (int step = 0; step < 5; ++step) {
        const double n = std::pow(4.0, step);
        const double own = (0.002 + 0.01 * number) * std::pow(n, -0.75) * jitter();
        const double error = std::hypot(own, base[4] == '1' ? 0.02 : 0.003) * jitter();
        const double ratio = (0.3 + 0.05 * number) * std::pow(n, 0.3) * (base[4] == '1' ? 1 : 2.5) * jitter();
        StudyPoint point = study_point(knob, base, std::to_string(int(n)), n, error, ratio);
        point.own_error = error_table(own);
        point.own_reference = std::string(knob) + " at 4096, " + base;
        point.front_confidence = double(engine() % 100) / 100;
        point.at_floor = error < 0.005;
        record.points.push_back(point);
      }
      record.fits.push_back({knob, base, "own reference", Metric::acuity_rmse, std::string(knob) + ", as set",
                             PowerFit{{-0.74, -0.80, -0.68}, {0, 0, 1e-4}, 0.002 + 0.01 * number, 0.06, 5},
                             "-0.75: a straight edge crosses sqrt(N) of N strata", ""});
    }
  }
  record.fits.push_back({"history", "N = 1", "endless effort", Metric::acuity_rmse, "frames", std::nullopt,
                         "", "the error rises with n"});
}

inline void mark_front(StudyRecord& record) {
  for (StudyPoint& point : record.points) {
    point.on_front = true;
    for (const StudyPoint& other : record.points) {
      if (other.time_ratio.estimate < point.time_ratio.estimate &&
          other.error.at(Metric::acuity_rmse) < point.error.at(Metric::acuity_rmse)) {
        point.on_front = false;
      }
    }
    if (point.on_front) point.front_confidence = 0.9;
  }
}

inline StudyRecord rich_record() {
  StudyRecord record;
  record.program = "herr 0.9";
  record.command_line =
      "herr study sessions/samples/desk-walk --scene scenes/samples/desk.glb --minutes 30 --out study";
  record.session = "desk-walk";
  record.scene = "desk.glb";
  record.profile = "two eyes with focus, 1832x1920";
  record.cpu = "Two-core machine at 2.1 GHz";
  record.isa = "AVX2";
  record.triangles = 2'345'678;
  record.threads = 2;
  record.minutes_allowed = 30;
  record.minutes_taken = 27.4;
  record.timing = StudyTiming{240, 0.062, 17, 0.61, "repeats differ, but not <much>"};
  record.default_settings = "polar 788x384, 1 light sample, 4 occlusion rays, history 8";
  for (int i = 0; i < 8; ++i) record.frames.push_back({100 + 37 * i, 1.1 + 0.41 * i, 12.5 * i, 3.3 * i});
  for (int i = 0; i < 6; ++i) record.clip.push_back({200 + i, 2.2 + i / 90.0, 1.5, 4});
  record.references = {
      {"soft light", "256 rays through each pixel, N = 64", 256, 512, error_table(4e-4), true, 91},
      {"hard light", "one ray for each light", 64, 64, error_table(2e-4), false, 12.5}};
  record.points.push_back(study_point("default", "", "788x384", 0, 0.021, 1));
  record.points.back().flicker = Flicker{{0.01, 0.02, 0.03, 0.04, 0.05, 0.03},
                                         {0.009, 0.018, 0.02, 0.03, 0.04, 0.02},
                                         {0.001, 0.002, 0.01, 0.01, 0.01, 0.01}};
  add_sweeps(record);
  for (int i = 0; i < 6; ++i) {
    const double size = std::pow(2.0, i - 3);
    record.points.push_back(study_point("uniform", "", std::to_string(i), size, 0.03 / size, 1.7 * size));
    record.points.push_back(study_point("paper", "", std::to_string(i + 1), 0, 0.028 / size, 1.2 * size));
  }
  record.points.push_back(study_point("combination", "", "no. 1", 0, 0.006, 1.4));
  record.points.push_back(study_point("edge", "N = 1", "0", 0, 0.021, 1));
  record.points.back().of_default = true;
  mark_front(record);
  record.advice = {{0.02, record.points[1].name, "For an error of at most 0.02 take light-samples 1, N = 1."},
                   {0.0001, "", "No setting reaches an error of at most 0.0001."}};
  record.advice_note = "Found at profile scale 0.4; confirm at full scale.";
  record.aims = {
      {"uniform is beaten at equal time", {1.9, 1.7, 2.2}, 1, true, true, "Ratio of errors."},
      {"N = 64 at full scale at least 8 times faster", {6.2, 5.9, 6.6}, 8, true, false, "Of 12 pairs."}};
  record.remarks = {{"mirror-rays", "the error does not fall"}, {"detail", "no mesh has levels"}};
  record.left_out = {"reflections: no material reflects"};
  record.dropped = {"probe-spacing 0.25: not enough time"};
  record.warnings = {"The machine's speed varied by 7 %."};
  record.pictures = {small_picture("default, left eye"), small_picture("uniform, left eye")};
  return record;
}

inline StudyRecord minimal_record() {
  StudyRecord record;
  record.session = "one";
  record.no_advice = "1 of 94 settings measured: no recommendation; give --minutes 7 or more";
  record.frames = {{0, 0, 0, 0}};
  return record;
}

// Names that are markup, bytes that are no text, and in every number what has no place in a diagram.
inline StudyRecord hostile_record() {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  const std::string bad = "<script>alert('x')</script>\"&\x1b[31m\xff\xc2\x9b";
  StudyRecord record = rich_record();
  for (std::string* text : {&record.program, &record.command_line, &record.session, &record.scene,
                            &record.profile, &record.cpu, &record.isa, &record.default_settings}) {
    *text = bad;
  }
  record.minutes_allowed = kNan;
  record.minutes_taken = kEndless;
  record.frames[0].gaze_deg = kNan;
  record.frames[1].time_s = -kEndless;
  record.references[0].name = record.references[0].settings = bad;
  record.references[0].seconds = kNan;
  const double values[] = {kNan, kEndless, -kEndless, 0, -1, 1e308, 5e-324, 1e39};
  for (std::size_t i = 0; i < record.points.size(); ++i) {
    StudyPoint& point = record.points[i];
    const double value = values[i % std::size(values)], other = values[i / 3 % std::size(values)];
    point.error.value[kAllPixels].fill(value);
    point.time_ratio = {other, value, values[i / 5 % std::size(values)]};
    point.front_confidence = point.frame_ms = point.n = value;
    point.bias = value;
    if (i % 3 == 0) point.knob = bad;
    if (i % 4 == 0) point.name = point.base = point.value = point.flags = point.own_reference = bad;
    point.counters[0].second = value;
    point.on_front = true;
  }
  for (StudyFit& fit : record.fits) {
    fit.theory = fit.remark = fit.effort = fit.against = bad;
    if (fit.fit)
      fit.fit->p = {kNan, -kEndless, kEndless}, fit.fit->c = kNan, fit.fit->relative_rms = kEndless;
  }
  record.points[0].flicker->test.fill(kNan);
  record.aims[0].measured = {kNan, kNan, kNan};
  record.aims[0].aim = kNan;
  record.aims[1].name = record.aims[1].sentence = bad;
  record.advice[0].sentence = record.advice[1].sentence = bad;
  record.advice_note = bad;
  record.advice[0].most_error = kNan;
  record.remarks[0] = {bad, bad};
  record.left_out = record.dropped = record.warnings = {bad, bad};
  record.pictures[0].title = record.pictures[0].caption = bad;
  return record;
}

}  // namespace herr::test
