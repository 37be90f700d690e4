// Everything that a report of a study is made of: the content of study.json. The report is a pure function of
// it, on any machine. Before: a study that has measured, or study.json read again. After: study_json,
// study_text, study_page.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/study/error/flicker.h"
#include "server/study/error/metrics.h"
#include "server/study/statistics/interval.h"
#include "server/study/statistics/power_fit.h"

namespace herr {

// Raised whenever a field changes its meaning.
inline constexpr int kStudyVersion = 1;

// Below so many times the reference's own error, an error is no more than a limit.
inline constexpr double kFloorOfReference = 3;

struct StudyFrame {
  std::int64_t number = 0;  // in the session
  double time_s = 0;        // since the session's start
  double head_deg_per_s = 0;
  double gaze_deg = 0;  // from straight ahead
};

// A picture that others are held against, and what it says of itself (frames together).
struct StudyReference {
  std::string name;       // "endless effort", "hard light", "--light-samples 64, 16 seeds"
  std::string settings;   // one line
  int passes = 0;         // per half at least: one ray through each pixel, or one frame of other seeds
  int most_passes = 0;    // where the halves differed
  ErrorTable error;       // its own
  bool goal_met = false;  // below 1/5 of the smallest error that is judged by it
  double seconds = 0;
};

// One setting, over its frames.
struct StudyPoint {
  std::string name;         // "polar 788x384, N = 1": unique
  std::string knob;         // which sweep: a setting's name, or "default", "combination", "uniform", "paper"
  std::string base;         // what it is swept around: "N = 1", "N = 64"
  std::string value;        // "788x384"
  double n = 0;             // effort: samples, rays, or scale; 0: a word, not a number
  std::string flags;        // that give it: "--polar 788x384 --light-samples 64"
  int frames = 0;           // that it was measured on
  bool of_default = false;  // a point of a sweep that the default's own frames give: not measured again

  ErrorTable error;                     // against the picture that endless effort would give
  std::optional<ErrorTable> own_error;  // against endless effort of this knob alone, all others as here
  std::string own_reference;            // which one; empty without own_error
  bool at_floor = false;                // acuity-weighted: below 3 times the error of the reference
  std::optional<double> bias;           // RMSE of the mean over many seeds, noise taken out; own reference

  bool comparable =
      false;  // lit as the default is and on all frames: its error compares with that of the others

  Interval time_ratio;                                   // to the default, paired
  Interval work_ratio;                                   // the same without the stage from samples to pixels
  double frame_ms = 0;                                   // median
  double pixels_ms = 0;                                  // of that, the stage from samples to viewport pixels
  double calibration_ms = 0;                             // bare rays beside it: how fast the machine was
  std::vector<std::pair<std::string, double>> counters;  // mean per frame, in order: "primary_rays", ...

  bool on_front = false;        // no point beats it in acuity-weighted RMSE and time
  double front_confidence = 0;  // share of bootstrap draws in which it is there
  std::optional<Flicker> flicker;
};

// How the error of one knob falls.
struct StudyFit {
  std::string knob, base;
  std::string against;  // "own reference", "endless effort"
  Metric metric = Metric::acuity_rmse;
  std::string effort;  // what n counts: "samples per light", "polar samples per side"
  std::optional<PowerFit> fit;
  std::string theory;  // "-0.75: a straight edge crosses sqrt(N) of N strata"; empty: none is known
  std::string remark;  // why there is none, or what is odd ("the error rises with n"); mostly empty
};

// What a knob did, in words, where it is not as expected: "no material reflects", "the error does not fall".
struct StudyRemark {
  std::string knob, text;
};

// "for an error of at most ... take ...": one line each.
struct StudyAdvice {
  double most_error = 0;  // acuity-weighted RMSE
  std::string point;      // name of a StudyPoint; empty: none reaches it
  std::string sentence;
};

// A claim that the study was asked to test, missed or met: told first when missed.
struct StudyAim {
  std::string name;  // "N = 64 at full scale at least 8 times faster than rays per pixel"
  Interval measured;
  double aim = 0;
  bool at_least = true;  // the measured value should be at least (at most) the aim
  bool met = false;      // the estimate meets it
  std::string sentence;  // how it was measured
};

// How the machine was while times were measured (findings/study_timing.h).
struct StudyTiming {
  int pairs = 0;
  double spread = 0;  // of ratios of one setting, a share
  double preemptions = 0;
  std::optional<double> cpu_share;  // of the cores that the frames' threads could have had
  std::string
      sentence;  // one line: by how much ratios are uncertain, and on a busy machine why and what to do
};

// PNG bytes, in base64 within JSON.
struct StudyPicture {
  std::string title;    // "default, left eye: picture | reference | error x 16"
  std::string caption;  // a sentence
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> png;
};

// What a report is about, and on which machine.
struct ReportHead {
  std::string program;       // "herr 0.x"
  std::string command_line;  // that does it again
  std::string session, scene, profile, cpu, isa;
  std::int64_t triangles = 0;
  int threads = 0;
};

struct StudyRecord : ReportHead {
  double minutes_allowed = 0, minutes_taken = 0;
  std::string default_settings;       // one line
  std::optional<StudyTiming> timing;  // none in reports of earlier programs
  std::vector<StudyFrame> frames, clip;
  std::vector<StudyReference> references;
  std::vector<StudyPoint> points;
  std::vector<StudyFit> fits;
  std::vector<StudyAdvice> advice;
  std::string advice_note;  // what holds for all advice: found at less than full profile scale; mostly empty
  std::string no_advice;    // why there is none: too little was measured, and how much time it takes
  std::vector<StudyAim> aims;
  std::vector<StudyRemark> remarks;
  std::vector<std::string> left_out;  // the scene has nothing for them: "reflections: no material reflects"
  std::vector<std::string> dropped;   // the time was not enough for them
  std::vector<std::string> warnings;
  std::vector<StudyPicture> pictures;
};

}  // namespace herr
