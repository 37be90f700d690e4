// One way of reading a recording, axes and all, and how the data look in it. Before: axis_conventions,
// trial_import. After: axis_trials excludes; gaze_trials goes on with the gaze.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sessions/import/check/axis_conventions.h"
#include "sessions/import/map/column_map.h"
#include "sessions/import/presets/fitting_columns.h"
#include "sessions/import/presets/trial_import.h"

namespace herr {

struct AxisCandidate {
  std::size_t reading = 0, convention = 0;
  std::shared_ptr<const ColumnMap> map;
  TrialImport trial;
  std::string against;  // what excludes it, after "with these axes"; empty: nothing does

  const AxisConvention& axes() const { return axis_conventions()[convention]; }
  const PlausibilityFigures& figures() const { return trial.figures; }
};

// `with_gaze`: false leaves the gaze out.
AxisCandidate tried(const RecordingFiles& files, ColumnMap map, std::size_t reading, std::size_t convention,
                    bool with_gaze);
void set_head_axes(ColumnMap& map, std::size_t convention);

// Of those that nothing excludes, one for each meaning.
std::vector<const AxisCandidate*> remaining(const std::vector<AxisCandidate>& candidates);

}  // namespace herr
