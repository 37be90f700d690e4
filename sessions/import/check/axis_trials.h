// Reads a recording with the axes of every convention and keeps those in which it looks like a person's head
// and eyes: level, steadily upright, walking ahead, with eyes that rest ahead and counter the head. Mirrored
// and turned readings look alike without walking and gaze: then nothing is claimed.
// Before: axis_conventions, a column map without axes. After: proposed_map.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sessions/import/check/axis_conventions.h"
#include "sessions/import/map/column_map.h"
#include "sessions/import/presets/fitting_columns.h"
#include "sessions/import/presets/trial_import.h"

namespace herr {

// One way to read the columns, with everything but the axes.
struct AxisReading {
  ColumnMap map;                         // one head, and at most one gaze
  std::vector<std::size_t> conventions;  // that could be; empty: all
  std::optional<std::size_t> only_one;   // of these, the one that its names and units belong to
  std::optional<GazeSpace> space;        // of the gaze, where it is known
  std::string reason;                    // why the columns are read so
};

struct AxisVerdict {
  std::optional<ColumnMap> map;    // settled
  std::optional<ColumnMap> draft;  // of what remained or was best
  const AxisConvention* axes = nullptr;
  std::size_t reading = 0;
  std::size_t fitting = 0;                      // readings that fit alike; 1: settled
  TrialImport trial;                            // of the map or draft
  bool walks_ahead = false, eyes_tell = false;  // what spoke for it beyond being level
  std::vector<std::string> reasons, questions;
};

AxisVerdict settle_axes(const RecordingFiles& files, const std::vector<AxisReading>& readings);

}  // namespace herr
