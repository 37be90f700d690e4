// A folder that a program left: which of its files is the head's, the gaze, the pictures of each camera.
// Before: built_in_maps with their layouts. After: choose_format; the cameras of `herr convert`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sessions/import/presets/fitting_columns.h"

namespace herr {

struct FoundCamera {
  std::filesystem::path pictures, stamps, calibration;  // empty: none
  std::string names;                                    // pattern of stamps in the pictures' names
};

struct FoundRecording {
  RecordingFiles files;
  std::vector<FoundCamera> cameras;
  std::string preset;  // whose layout it is; empty: of several, which the columns tell apart
};

// `preset` empty: every built-in layout is tried; `map`: a map of the user's instead, or null. Of a preset's
// layouts whose head and gaze are there, one with gaze comes first, then the one with the most cameras, then
// the first; cameras that are not there are left out. Throws InputError that says what such folders hold, or
// which presets' layouts fit when several do.
FoundRecording find_recording(const std::filesystem::path& folder, const std::string& preset,
                              const ColumnMap* map = nullptr);

// Whether a file of this name is the head's (or the gaze's) in one of the map's layouts.
bool named_in_layouts(const std::filesystem::path& file, const ColumnMap& map);

}  // namespace herr
