// A folder that a program left: which of its files is the head's, the gaze, the pictures of each camera.
// Before: built_in_maps with their layouts. After: choose_format; the cameras of `herr convert`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sessions/import/map/column_map.h"
#include "sessions/import/presets/choose_format.h"

namespace herr {

struct FoundRecording {
  RecordingFiles files;
  struct Camera {
    std::filesystem::path pictures, stamps, calibration;  // empty: none
    std::string names;
  };
  std::vector<Camera> cameras;
  std::string preset;  // whose layout it is
};

// `preset` empty: every built-in layout is tried. Of a preset's layouts whose head and gaze are there, one
// with gaze comes first, then the one with the most cameras, then the first; cameras that are not there are
// left out. Throws InputError that says what such folders hold, or which presets' layouts fit when several
// do.
FoundRecording find_recording(const std::filesystem::path& folder, const std::string& preset);

}  // namespace herr
