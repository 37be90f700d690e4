// The same for the gaze: in which space and axes it is written, and which head it fits. Before:
// axis_candidates of the head that remain. After: axis_trials.
#pragma once

#include <string>
#include <vector>

#include "sessions/import/check/axis_candidates.h"
#include "sessions/import/check/axis_trials.h"

namespace herr {

struct GazeTrials {
  std::vector<AxisCandidate> candidates;
  bool eyes_tell = false;  // they counter the head in one reading clearly better than in the others
  std::vector<std::string> reasons, questions;
};
GazeTrials try_gaze(const RecordingFiles& files, const std::vector<const AxisCandidate*>& heads,
                    const std::vector<AxisReading>& readings);

}  // namespace herr
