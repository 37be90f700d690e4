// Renders one setting at one frame: its errors, its time beside the default's, its counters. Before: a
// StudySetting, references. After: StudyRow.
#pragma once

#include <vector>

#include "server/study/measure/paired_times.h"
#include "server/study/measure/references.h"
#include "server/study/measure/study_row.h"
#include "server/study/plan/study_setting.h"

namespace herr {

struct MeasuringRules {
  TimingRules timing;
  int bias_seeds = 4;          // more pictures, of other seeds, of settings with a reference of seeds,
  double bias_frame_ms = 700;  // whose frames are not too long for that
};

// What stays the same for all settings of an instant.
struct MeasuringBench {
  const RenderSettings& defaults;
  const FrameInstant& instant;
  Renderer& unit;  // of the default settings, at the instant
  Calibration& calibration;
  References& references;
  MeasuringRules rules;
};

// `picture` (may be null) gets the viewports, limited to white.
StudyRow measure_setting(const StudySetting& setting, const MeasuringBench& bench,
                         std::vector<LinearPicture>* picture = nullptr);

}  // namespace herr
