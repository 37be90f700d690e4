// The file of a recording's gaze that lies beside that of its head, where the user named the head's alone.
// Before: the files that the user names. After: `herr convert` says so, its --check proposes it.
#pragma once

#include <filesystem>
#include <optional>

#include "sessions/import/presets/choose_format.h"

namespace herr {

// A file whose name is the head's with "gaze", "eye" or "eyes" in place of "head", "pose", "poses" or
// "trajectory", or with one of those behind it ("walk_gaze.csv" of "walk.csv"), or "gaze.csv" and the like,
// in the same folder, which together with the head has the format that `request` asks for. None where the
// request names a gaze, has none that moves, or has its gaze in the head's file.
std::optional<std::filesystem::path> gaze_beside(const FormatRequest& request);

}  // namespace herr
