// What a study sweeps: every setting whose effect is error_for_time, one after another, each around hard and
// soft light; rays per pixel at several scales; the paper's own settings. What the scene has nothing for is
// left out. Before: settings_list, the frame plan. After: study_run measures them in this order.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/frame_plan.h"
#include "server/study/plan/study_setting.h"

namespace herr {

// Sweeps are made around these, named "N = 1" and "N = 64".
inline constexpr int kHardSamples = 1, kSoftSamples = 64;

// "N = 64": StudySetting::base.
std::string base_name(int samples);

// Of the two settings that everything is swept around: "default, N = 64".
std::string default_name(int samples);

// A sweep, in words.
struct Knob {
  std::string name;    // of its settings: StudySetting::knob
  std::string label;   // "polar width and height"
  std::string effort;  // what n counts; empty: its values are words
  std::string theory;  // of the exponent of n, and why; empty: none is known
  // The error falls as n rises (1), rises with it (-1), or no such thing is expected (0).
  int expected = 0;
  double fit_from = 0;  // smaller n are no part of the power law
};

struct StudySweeps {
  std::vector<Knob> knobs;
  std::vector<StudySetting> settings;  // most wanted first
  // Of sweeps, with the settings of the default of their base and held against the same references: points
  // that the default's rows give (findings/default_points.h).
  std::vector<StudySetting> of_default;
  std::vector<std::string> left_out;  // "reflections: no material reflects"
};

// `plan_of`: the frame plan of the scene with other settings. Settings that no row of knobs.cpp knows are
// swept over a quarter to four times their default, or over their words.
StudySweeps sweeps_of(const RenderSettings& defaults,
                      const std::function<FramePlan(const RenderSettings&)>& plan_of);

}  // namespace herr
